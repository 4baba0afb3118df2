// The problem of a map at one degree, and the current point of a descent on it.
//
//     minimize  sum over faces weight_f int energy + added terms + energy of the surroundings
//     where     constraints, certificates and the barriers that replace bounds hold.
//
// Quadrature levels, weights of faces, the depth of certificates and the surroundings change during
// a descent; the problem and its stepper follow every change at once. The point x() is preserved by
// all of them. map_descent.h moves it.
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
  MapSpecification map;  // normalized
  SolveOptions solve;
  StopCheck stop;
  SolverRules rules;
  // The requested energy at 2 numbers per node, for the trace, if another energy is minimized.
  // Empty: that of `map`.
  std::function<double(VecIn)> requested_energy;
  MapObserver watch = {};  // is given an empty in_model_units; may be empty
};

// The bounds of MapSpecification::added, which depend only on the map's unknowns.
struct DegreeBounds {
  BarrierProblem::Bounds all;
  BarrierStage stage;  // the barriers that replace them; empty: the bounds are left out
};

class DegreeProblem {
 public:
  // x: start, 2 numbers per node of `space`, normalized, locally injective. x, setup and domain
  // outlive the problem. Throws InvalidArgument if an energy does not support the curvature;
  // Error(Infeasible) as start_on_constraints() does; Stopped.
  DegreeProblem(const DegreeSetup& setup, MapDomain& domain,
                std::shared_ptr<const BezierTriangleSpace> space, const Vec& x);
  // Has the bounds, and the barriers that replace them, of another problem of the degree.
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

  // Return the numbers of the map; all unknowns of the domain; the unknowns of the solver.
  Vec x() const { return x_.head(2 * space_->node_count()); }
  const Vec& unknowns() const { return x_; }
  Vec reduced() const { return built_.problem.reduce(x_); }
  void move_to(const Vec& reduced) { x_ = built_.problem.expand(reduced); }
  // Takes the point of another problem on the same domain.
  void take_point(const DegreeProblem& other) { x_ = other.x_; }
  double constraint_residual() const;

  // Returns the energy of the map alone on the present rules, all elements at full weight, plus
  // that of added terms.
  double own_energy(VecIn x) const;
  // Returns the part of the problem's energy at the point that is not own_energy().
  double foreign_energy() const;
  Vec energy_by_face() const;

  int depth() const { return depth_; }  // of certificates
  void set_depth(int depth);
  const std::vector<RuleId>& levels() const { return levels_.of_faces(); }
  void set_levels(std::vector<RuleId> levels);
  // Returns whether the quadrature of any of these faces was refined.
  bool refine(const std::vector<Index>& faces);
  // Refines the elements whose integrals are worst until the remaining error is within the bound.
  // Returns whether there were any.
  bool refine_inaccurate();
  // Sets factors of the faces' energies, #F; empty: 1.
  void weigh_faces(Vec weight);

  // Adapts the surroundings to the point, which was reached by `step`, or from which no step was
  // possible.
  DomainChange adapt(const StepResult& step) { return domain_.after_step(x_, step, depth_); }
  // Updates states of the domain that follow the point. Returns whether there are any.
  bool follow();
  void rebuild();
  // Replaces the bounds by the barriers of this stage; barriers() are its terms.
  void enter(const BarrierStage& stage);
  std::span<const TermId> barriers() const;

  // A point to which a run can return.
  struct Checkpoint {
    Vec x;
    std::optional<Scaffold> surroundings;
  };
  Checkpoint checkpoint() const { return {x_, domain_.surroundings()}; }
  void return_to(const Checkpoint& checkpoint);

  // Return and add to the numbers of faces proven injective, by depth of bisection, in all checks
  // so far.
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
