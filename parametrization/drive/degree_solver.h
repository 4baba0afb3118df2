// The optimization at one degree: Newton on a fixed space, with quadrature that climbs where it
// must and the ways out of a stall at the injectivity limit.
//
// Internal to parametrize(). Coordinates are normalised (see NormalizedStart). Whatever is stopped,
// x() is the best point reached.
#pragma once

#include <memory>
#include <vector>

#include "majorant/framework/newton.h"
#include "majorant/parametrization/drive/parametrize.h"
#include "majorant/parametrization/maps/map_problem.h"
#include "majorant/parametrization/maps/quadrature_levels.h"

namespace majorant {

class DegreeSolver {
 public:
  struct Setup {
    MapSpecification map;            // normalised
    ParametrizationOptions options;  // how to solve: curvature, tolerance, quadrature, depth
    StopCheck stop;
  };

  // x: start, 2 numbers per node of `space`, normalised, locally injective. Throws Error(Usage)
  // when an energy does not support the curvature; Stopped.
  DegreeSolver(const Setup& setup, std::shared_ptr<const BezierTriangleSpace> space, Vec x);

  // For a start of enormous energy (a Tutte map with nearly collapsed triangles): steps on
  // sum A sqrt(density) by reweighting, until the mean density is moderate. Otherwise the stiff
  // triangles' rounding errors drive everything else, and which minimum is reached is chance.
  void soften_start(RunRecord& record);
  // Until one iteration decreases the energy by less than `tolerance`; no way out of stalls is
  // tried. For degrees on the way.
  SolveResult approach(double tolerance, RunRecord& record);
  // To the documented stopping rules, with all means.
  SolveResult finish(RunRecord& record);

  const Vec& x() const { return x_; }
  Index variables() const { return problem_.size(); }
  double constraint_residual() const;
  std::vector<long> injectivity_depth_counts() const;

 private:
  Problem build_problem() const;
  SolveResult run_once(const StoppingRules& rules, RunRecord& record);
  bool deepen();
  void apply_state();
  bool climb(const std::vector<Index>& elements);
  bool climb_inaccurate();
  void help(SolveResult& result, const StoppingRules& rules, RunRecord& record);
  SolveResult exhaust(RunRecord& record);
  SolveResult follow_barrier(const SolveResult& stalled, RunRecord& record);
  SolveResult leave_stall(const SolveResult& stalled, RunRecord& record);
  SolveResult back_to(const Vec& best, SolveResult stalled, Status way_out);
  bool step_aside(double weight, RunRecord& record);

  const Setup& setup_;
  std::shared_ptr<const BezierTriangleSpace> space_;
  Vec x_, start_;
  QuadratureLevels levels_;
  DensityTerms terms_;
  int depth_;
  std::shared_ptr<const LocalInjectivity> injectivity_;
  std::vector<long> depth_counts_;  // of checkers that are gone
  Vec element_weight_;              // 1, or less where temporarily excluded
  Problem problem_;
  NewtonStepper stepper_;
};

}  // namespace majorant
