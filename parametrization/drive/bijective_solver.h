// The optimization at one degree with a scaffold around the image: like DegreeSolver, but the image
// stays free of overlaps. [MC20] Sec. 6.
//
// Internal to parametrize(). Every iteration is one Newton step on
//     E(map) + lambda E_conf(scaffold),   lambda = 1e-3 E(map) / E_conf(scaffold),
// then the scaffold's edges are flipped and its triangles relaxed with the image fixed.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "majorant/framework/newton.h"
#include "majorant/parametrization/drive/degree_solver.h"
#include "majorant/parametrization/scaffold/scaffold.h"

namespace majorant {

class BijectiveSolver {
 public:
  // As DegreeSolver; scaffold: around x. When stopped, x() and scaffold() belong together.
  BijectiveSolver(const DegreeSolver::Setup& setup,
                  std::shared_ptr<const BezierTriangleSpace> space, Vec x, Scaffold scaffold);

  // Until one iteration decreases the energy by less than `tolerance`; for degrees on the way.
  SolveResult approach(double tolerance, RunRecord& record);
  // To the documented stopping rules, bisecting deeper and refining quadrature where held back.
  SolveResult finish(RunRecord& record);

  Vec x() const { return x_.head(2 * space_->node_count()); }
  const Scaffold& scaffold() const { return scaffold_; }
  const FlipCounts& flips() const { return flips_; }
  Index variables() const { return problem_.size(); }
  double constraint_residual() const;
  std::vector<long> injectivity_depth_counts() const;

 private:
  void rebuild();
  void set_states();
  FlipCounts flip();
  double scaffold_energy() const;  // E_conf of all scaffold triangles at x_
  SolveResult run(const StoppingRules& rules, RunRecord& record);
  void iterate_until(const StoppingRules& rules, RunRecord& record, SolveResult& result);
  Stepper::Step iterate(SolveResult& result);
  bool maintain(const IterationRecord& step, const std::vector<Index>& blocking);
  void refine_scaffold(const std::vector<Index>& blocking);
  bool help(const std::vector<Index>& blocking);

  const DegreeSolver::Setup& setup_;
  std::shared_ptr<const BezierTriangleSpace> space_;
  Vec x_;  // joint: the map's nodes, then the scaffold's own
  const Vec start_;
  Scaffold scaffold_;
  QuadratureLevels levels_;
  DensityTerms terms_;
  int depth_;
  std::shared_ptr<const LocalInjectivity> injectivity_;
  std::vector<long> depth_counts_;  // of checkers that are gone
  FlipCounts flips_;
  std::optional<double> lambda_;  // none: not set since the problem was built
  Problem problem_;
  std::unique_ptr<NewtonStepper> stepper_;
};

}  // namespace majorant
