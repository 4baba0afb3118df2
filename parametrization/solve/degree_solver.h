// The optimization at one degree: Newton on a fixed space, on whatever domain, with quadrature that
// is refined where it must be and the remedies for stalls at the limit of the feasible set.
//
//     DegreeSolver solver(setup, domain, map.shared_space(), map.control_points());
//     solver.soft_start(record);
//     SolveResult solved = solver.finish(record);
//     map = map.with(map.shared_space(), solver.x());
//
// Internal to parametrize(). Coordinates are normalised (see NormalizedStart). Whatever is stopped,
// x() is the best point reached, and the domain's surroundings belong to it. Where the map is in
// parts (MapSpecification::part) setup.stop never stops, and the record agrees with the others'.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "majorant/framework/barrier_minimizer.h"
#include "majorant/framework/newton.h"
#include "majorant/framework/partition.h"
#include "majorant/framework/pattern_analysis.h"
#include "majorant/framework/run_record.h"
#include "majorant/maps/map_options.h"
#include "majorant/maps/map_problem.h"
#include "majorant/parametrization/solve/internal/map_domain.h"
#include "majorant/parametrization/solve/internal/quadrature_levels.h"
#include "majorant/parametrization/solve/solver_rules.h"

namespace majorant {

class DegreeSolver {
 public:
  struct Setup {
    MapSpecification map;  // normalised
    SolveOptions solve;
    StopCheck stop;
    SolverRules rules;
    // The energy asked for, at 2 numbers per node, for the trace, where another energy is
    // minimized. Empty: that of `map`.
    std::function<double(VecIn)> asked_energy;
    MapObserver watch = {};  // in_model_units is empty there; may be empty
  };

  // Together with x() the state from which another solver of the same degree goes on. Newton's
  // method learns again what it has learned of late.
  struct State {
    bool soft_started = false;        // soft_start() is through
    int stalls = 0, refinements = 0;  // remedies tried, times the quadrature was refined
    bool barrier_followed = false;
    int depth = 0;               // of certificates
    std::vector<RuleId> levels;  // of quadrature, by face; empty: the lowest
    RemedyUses remedies{};
  };

  // x: start, 2 numbers per node of `space`, normalised, locally injective; x, setup and domain
  // outlive the solver's steps. Throws InvalidArgument when an energy does not support the
  // curvature, Error(Infeasible) when x, moved to where it satisfies added constraints, is not
  // injective; Stopped.
  DegreeSolver(const Setup& setup, MapDomain& domain,
               std::shared_ptr<const BezierTriangleSpace> space, const Vec& x);

  // Takes, from a start of enormous energy (a Tutte map with nearly collapsed triangles), steps on
  // sum A sqrt(density) by reweighting, until the mean density is moderate. Otherwise the stiff
  // triangles' rounding errors drive everything else, and which minimum is reached is chance.
  void soft_start(RunRecord& record);
  // Descends until one iteration decreases the energy by less than `tolerance`, without remedies:
  // for degrees on the way.
  SolveResult approach(double tolerance, RunRecord& record, Phase phase = Phase::Newton);
  // Descends to the documented stopping rules, with all remedies.
  SolveResult finish(RunRecord& record);
  // None on the way around a stall: that leads on from x(), or back to where it began. May be asked
  // by setup.watch.
  std::optional<State> state() const;
  // Called before any step. Throws InvalidArgument for levels that the setup's quadrature does not
  // have.
  void resume(State state);
  // The record of a step from here, for its cost; the step is not taken, and in no trace.
  IterationRecord try_step();

  Vec x() const { return x_.head(2 * space_->node_count()); }
  GlobalIndex variables() const { return partition().global_size(); }
  double constraint_residual() const;
  const RemedyUses& remedies() const { return uses_; }
  // Faces proven injective, by depth of bisection, in all checks so far.
  std::vector<long> proven() const;

 private:
  // Bounds with a barrier, those of MapSpecification::added; they see the map's unknowns alone.
  struct Bounds {
    BarrierProblem::Bounds all;
    BarrierStage stage;  // in place of them; empty: they are left out
  };
  DegreeSolver(const Setup& setup, MapDomain& domain,
               std::shared_ptr<const BezierTriangleSpace> space, const Vec& x, Bounds bounds,
               std::shared_ptr<PreparedParts> prepared = nullptr);

  // A point that a run can come back to.
  struct Checkpoint {
    Vec x;
    std::optional<Scaffold> surroundings;
  };
  class MapDescent;
  class SoftStart;
  class WithinBounds;
  // The outcome of a remedy: it could not help, the run goes on from a new point, or it has ended.
  enum class RemedyOutcome { None, GoOn, Ended };

  const Partition& partition() const { return partition_of(built_.problem); }
  MapProblem build();
  std::span<const TermId> barriers() const;
  void meet_added_constraints();
  void rebuild();
  void apply_state();
  void renew_states();
  bool follow();
  Checkpoint checkpoint() const { return {x_, domain_.surroundings()}; }
  void return_to(const Checkpoint& checkpoint);
  double own_energy(VecIn x) const;
  double foreign_energy() const;
  Directive note(const IterationRecord& own, StepResult::Outcome outcome, Phase phase,
                 RunRecord& record) const;

  SolveResult descend(StoppingRules rules, Phase phase, RunRecord& record);
  void take_soft_steps(RunRecord& record);
  std::optional<Vec> soft_weights() const;
  bool refine_inaccurate();
  StoppingRules unlimited(double relative_decrease) const;
  StoppingRules final_rules() const;

  SolveResult solve_within_bounds(RunRecord& record);
  BarrierOptions barrier_options(double energy) const;
  void enter(const BarrierStage& stage);

  // Remedies.
  const RemedyRules& rules() const { return setup_.rules.remedies; }
  // The number of times that remedies were tried at this degree.
  struct RemedyCounts {
    int stalls = 0, refinements = 0;
  };
  SolveResult exhaust(std::span<const Remedy> remedies, RemedyCounts& counts, RunRecord& record);
  bool relieve(std::span<const Remedy> remedies, SolveResult& result, RunRecord& record);
  RemedyOutcome apply(Remedy remedy, SolveResult& result, RunRecord& record);
  void set_depth(int depth);
  RemedyOutcome deepen(RunRecord& record);
  RemedyOutcome refine(const std::vector<Index>& blocking, RunRecord& record);
  RemedyOutcome exclude(SolveResult& result, RunRecord& record);
  RemedyOutcome follow_strong_barrier(SolveResult& result, RunRecord& record);
  bool step_aside(double unit, RunRecord& record);
  bool approach_with(double weight, RunRecord& record);
  SolveResult back_to(const Checkpoint& best, SolveResult stalled, Status way_out);

  const Setup& setup_;
  MapDomain& domain_;
  std::shared_ptr<const BezierTriangleSpace> space_;
  const Vec& start_;
  QuadratureLevels levels_;
  DensityTerms terms_;
  int depth_;
  std::shared_ptr<const LocalInjectivity> injectivity_;
  std::vector<long> proven_inside_;  // by the solves along a barrier
  Vec element_weight_;               // empty: 1; else for a while: soft start, excluded
  Vec x_;                            // unknowns of the domain, the map's first
  Bounds bounds_;
  // Made beside the start; while this is constructed; null: nothing was.
  std::shared_ptr<PreparedParts> prepared_;
  MapProblem built_;
  NewtonStepper stepper_;
  double began_at_ = 0;  // own energy at the start of the last descent
  bool soft_started_ = false;
  RemedyCounts remedy_counts_;
  int running_remedies_ = 0;       // remedies that are taking steps
  bool barrier_followed_ = false;  // once a degree
  RemedyUses uses_{};
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
