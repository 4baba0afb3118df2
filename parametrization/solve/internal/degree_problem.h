// The problem of a map at one degree, and the point that a descent has reached on it.
//
//     minimize  sum over faces weight_f int energy + terms added + energy of the surroundings
//     where     constraints, certificates and what stands in place of bounds hold.
//
// Quadrature levels, weights of faces, the depth of certificates and the surroundings change on the
// way; the problem and its stepper follow every change at once. x() is the point: it survives all
// of them. How it moves: map_descent.h.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "majorant/framework/barrier_minimizer.h"
#include "majorant/framework/newton.h"
#include "majorant/framework/partition.h"
#include "majorant/maps/map_options.h"
#include "majorant/maps/map_problem.h"
#include "majorant/parametrization/solve/internal/map_domain.h"
#include "majorant/parametrization/solve/internal/quadrature_levels.h"
#include "majorant/parametrization/solve/solver_rules.h"

namespace majorant {

struct DegreeSetup {
  MapSpecification map;  // normalised
  SolveOptions solve;
  StopCheck stop;
  SolverRules rules;
  // The energy of the request, at 2 numbers per node, for the trace, where another energy is
  // minimized. Empty: that of `map`.
  std::function<double(VecIn)> requested_energy;
  MapObserver watch = {};  // in_model_units is empty there; may be empty
};

// Bounds with a barrier, those of MapSpecification::added; they see the map's unknowns alone.
struct DegreeBounds {
  BarrierProblem::Bounds all;
  BarrierStage stage;  // in place of them; empty: they are left out
};

class DegreeProblem {
 public:
  // x: start, 2 numbers per node of `space`, normalised, locally injective; x, setup and domain
  // outlive the problem. Throws InvalidArgument when an energy does not support the curvature;
  // Error(Infeasible) as start_on_constraints() does; Stopped.
  DegreeProblem(const DegreeSetup& setup, MapDomain& domain,
                std::shared_ptr<const BezierTriangleSpace> space, const Vec& x);
  // With the same bounds, and what stands in place of them, as another problem of the degree.
  DegreeProblem(const DegreeSetup& setup, MapDomain& domain,
                std::shared_ptr<const BezierTriangleSpace> space, const Vec& x,
                DegreeBounds bounds);
  DegreeProblem(const DegreeProblem&) = delete;
  DegreeProblem& operator=(const DegreeProblem&) = delete;

  const DegreeSetup& setup() const { return setup_; }
  MapDomain& domain() const { return domain_; }
  const std::shared_ptr<const BezierTriangleSpace>& space() const { return space_; }
  const DegreeBounds& bounds() const { return bounds_; }
  NewtonStepper& stepper() { return stepper_; }
  Evaluator& evaluator() { return stepper_.evaluator(); }
  const Partition& partition() const { return partition_of(built_.problem); }
  GlobalIndex variables() const { return partition().global_size(); }

  // The map's numbers; all unknowns of the domain; those of the solver.
  Vec x() const { return x_.head(2 * space_->node_count()); }
  const Vec& unknowns() const { return x_; }
  Vec reduced() const { return built_.problem.reduce(x_); }
  void move_to(const Vec& reduced) { x_ = built_.problem.expand(reduced); }
  // Takes the point of another problem on the same domain.
  void take_point(const DegreeProblem& other) { x_ = other.x_; }
  double constraint_residual() const;

  // The energy of the map alone on the present rules, all elements at their full weight, and of the
  // terms that were added.
  double own_energy(VecIn x) const;
  // The part of the problem's energy at the point that is not own_energy().
  double foreign_energy() const;
  Vec energy_by_face() const;

  int depth() const { return depth_; }  // of certificates
  void set_depth(int depth);
  const std::vector<RuleId>& levels() const { return levels_.of_faces(); }
  void set_levels(std::vector<RuleId> levels);
  // Returns whether any of these faces got finer quadrature.
  bool refine(const std::vector<Index>& faces);
  // Refines the elements whose integrals are worst until the rest is within the bound. Returns
  // whether there were any.
  bool refine_inaccurate();
  // Factors of the faces' energies, #F; empty: 1.
  void weigh_faces(Vec weight);

  // Adapts the surroundings to the point, which was reached by `step` or could not be left.
  DomainChange adapt(const StepResult& step) { return domain_.after_step(x_, step, depth_); }
  // Returns whether the domain has states that follow the point.
  bool follow();
  void rebuild();
  // Puts the stage in place of the bounds; barriers() are its terms.
  void enter(const BarrierStage& stage);
  std::span<const TermId> barriers() const;

  // A point that a run can come back to.
  struct Checkpoint {
    Vec x;
    std::optional<Scaffold> surroundings;
  };
  Checkpoint checkpoint() const { return {x_, domain_.surroundings()}; }
  void return_to(const Checkpoint& checkpoint);

  // Faces proven injective, by depth of bisection, in all checks so far, and in those added.
  std::vector<long> proven() const;
  void add_proven(const std::vector<long>& counts);

 private:
  DegreeProblem(const DegreeSetup& setup, MapDomain& domain,
                std::shared_ptr<const BezierTriangleSpace> space, const Vec& x, DegreeBounds bounds,
                std::shared_ptr<PreparedParts> prepared);

  MapProblem build();
  void renew();
  void renew_states();
  bool follow_states();

  const DegreeSetup& setup_;
  MapDomain& domain_;
  std::shared_ptr<const BezierTriangleSpace> space_;
  const Vec& start_;
  QuadratureLevels levels_;
  DensityTerms terms_;
  int depth_;
  std::shared_ptr<const LocalInjectivity> injectivity_;
  std::vector<long> proven_elsewhere_;
  Vec face_weight_;  // empty: 1
  Vec x_;            // unknowns of the domain, the map's first
  DegreeBounds bounds_;
  MapProblem built_;
  NewtonStepper stepper_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
