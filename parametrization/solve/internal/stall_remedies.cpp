#include "majorant/parametrization/solve/internal/stall_remedies.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "majorant/energies/densities/symmetric_dirichlet.h"
#include "majorant/parametrization/solve/internal/map_descent.h"

namespace majorant {
namespace {

// The outcome of a remedy: it cannot help, the run continues from a new point, or it has ended.
enum class RemedyOutcome { None, GoOn, Ended };

class RunningRemedy {
 public:
  explicit RunningRemedy(int& count) : count_(count) { ++count_; }
  ~RunningRemedy() { --count_; }
  RunningRemedy(const RunningRemedy&) = delete;
  RunningRemedy& operator=(const RunningRemedy&) = delete;

 private:
  int& count_;
};

// Returns the symmetric Dirichlet density of isometries.
double least_density() { return symmetric_dirichlet_density().value({1.0, 0.0, 0.0, 0.0}); }

void add_use(RemedyUses& uses, Remedy remedy, double gained) {
  RemedyUse& use = uses[static_cast<std::size_t>(remedy)];
  ++use.runs;
  use.gained += gained;
}

// Returns the faces of the map; the domain handles its own.
std::vector<Index> faces_of_map(const DegreeProblem& problem, const std::vector<Index>& blocking) {
  std::vector<Index> faces;
  for (const Index e : blocking)
    if (e < problem.space()->element_count()) faces.push_back(e);
  return faces;
}

// The remedies of one run.
class StallRemedies {
 public:
  StallRemedies(DegreeProblem& problem, RemedyState& state, RunRecord& record)
      : problem_(problem), state_(state), record_(record) {}

  SolveResult exhaust(std::span<const Remedy> remedies, RemedyState::Counts& counts);

 private:
  const RemedyRules& rules() const { return problem_.setup().rules.remedies; }
  SolveResult descend(const StoppingRules& rules, Phase phase) {
    return majorant::descend(problem_, rules, phase, record_).result;
  }
  bool relieve(std::span<const Remedy> remedies, SolveResult& result);
  RemedyOutcome apply(Remedy remedy, SolveResult& result);
  RemedyOutcome deepen();
  RemedyOutcome refine(const std::vector<Index>& blocking);
  RemedyOutcome exclude(SolveResult& result);
  RemedyOutcome follow_strong_barrier(SolveResult& result);
  bool step_aside(double unit);
  bool approach_with(double weight);
  SolveResult back_to(const DegreeProblem::Checkpoint& best, SolveResult stalled, Status way_out);

  DegreeProblem& problem_;
  RemedyState& state_;
  RunRecord& record_;
};

SolveResult StallRemedies::exhaust(std::span<const Remedy> remedies, RemedyState::Counts& counts) {
  SolveResult result = descend(final_rules(problem_), Phase::Newton);
  try {
    for (;;) {
      if (result.status == Status::Stalled && counts.stalls++ < rules().stall_rounds) {
        if (!relieve(remedies, result)) return result;
      } else if (result.status == Status::Converged &&
                 counts.refinements++ < problem_.setup().rules.accuracy_rounds &&
                 problem_.refine_inaccurate()) {
        result = descend(final_rules(problem_), Phase::Newton);
      } else {
        return result;
      }
    }
  } catch (const Stopped& stop) {
    return stopped(std::move(result), stop.why());
  }
}

// Tries remedies until one changes something, then continues the run. Returns whether there was
// one.
bool StallRemedies::relieve(std::span<const Remedy> remedies, SolveResult& result) {
  for (const Remedy remedy : remedies) {
    const double before = result.energy;
    const RemedyOutcome outcome = apply(remedy, result);
    if (was_stopped(result.status) || outcome == RemedyOutcome::Ended) return false;
    if (outcome == RemedyOutcome::None) continue;
    const double gained = before - result.energy;
    MapDescentResult run =
        majorant::descend(problem_, final_rules(problem_), Phase::Newton, record_);
    result = std::move(run.result);
    add_use(state_.uses, remedy, gained + run.start_energy - result.energy);
    return true;
  }
  return false;
}

RemedyOutcome StallRemedies::apply(Remedy remedy, SolveResult& result) {
  const RunningRemedy running(state_.running);
  switch (remedy) {
    case Remedy::Deepen:
      return deepen();
    case Remedy::Refine:
      return refine(result.blocking);
    case Remedy::Exclude:
      return exclude(result);
    case Remedy::FollowBarrier:
      return follow_strong_barrier(result);
  }
  return RemedyOutcome::None;
}

RemedyOutcome StallRemedies::deepen() {
  if (problem_.depth() >= rules().deepest_bisection) return RemedyOutcome::None;
  problem_.setup().stop.poll();
  problem_.set_depth(
      std::min(problem_.depth() + rules().bisections_deeper, rules().deepest_bisection));
  record_.mark(Remedy::Deepen);
  return RemedyOutcome::GoOn;
}

RemedyOutcome StallRemedies::refine(const std::vector<Index>& blocking) {
  if (!problem_.refine(faces_of_map(problem_, blocking))) return RemedyOutcome::None;
  record_.mark(Remedy::Refine);
  return RemedyOutcome::GoOn;
}

RemedyOutcome StallRemedies::exclude(SolveResult& result) {
  const SolveResult stalled = result;
  const std::vector<Index> excluded = faces_of_map(problem_, stalled.blocking);
  if (!problem_.partition().any(!excluded.empty())) return RemedyOutcome::None;
  Vec weight = Vec::Ones(problem_.space()->element_count());
  for (const Index e : excluded) weight[e] = rules().excluded_weight;
  record_.mark(Remedy::Exclude);
  const DegreeProblem::Checkpoint best = problem_.checkpoint();
  problem_.weigh_faces(std::move(weight));
  StoppingRules brief = unlimited_rules(problem_.setup(), rules().excluded_tolerance);
  brief.max_iterations = rules().excluded_iterations;
  descend(brief, Phase::Excluded);
  problem_.weigh_faces({});
  result = descend(unlimited_rules(problem_.setup(), rules().excluded_tolerance), Phase::Newton);
  if (result.energy < stalled.energy) return RemedyOutcome::GoOn;
  result = back_to(best, stalled, result.status);
  add_use(state_.uses, Remedy::Exclude, 0);
  return RemedyOutcome::None;
}

// Returns to the best point after a remedy that failed or was stopped.
SolveResult StallRemedies::back_to(const DegreeProblem::Checkpoint& best, SolveResult stalled,
                                   Status way_out) {
  problem_.return_to(best);
  if (!was_stopped(way_out)) return stalled;
  return stopped(std::move(stalled),
                 way_out == Status::TimeLimit ? Directive::TimeLimit : Directive::Interrupt);
}

// The map's barrier is symmetric Dirichlet, unless its energy already contains that; the
// surroundings have their own barrier.
RemedyOutcome StallRemedies::follow_strong_barrier(SolveResult& result) {
  if (std::exchange(state_.barrier_followed, true)) return RemedyOutcome::None;
  RemedyOutcome outcome = RemedyOutcome::None;
  for (int round = 0; round < rules().barrier_rounds && result.status == Status::Stalled; ++round) {
    const SolveResult stalled = result;
    const DegreeProblem::Checkpoint best = problem_.checkpoint();
    if (!step_aside(std::abs(stalled.energy) / least_density())) break;
    outcome = RemedyOutcome::Ended;
    RemedyState::Counts counts;
    result = exhaust(std::span(kRemedies).first(static_cast<std::size_t>(Remedy::FollowBarrier)),
                     counts);
    // Both energies use the same rules, which may have become finer in between.
    const double gained = problem_.own_energy(best.x) - problem_.own_energy(problem_.unknowns());
    add_use(state_.uses, Remedy::FollowBarrier, std::max(gained, 0.0));
    if (!(gained > 0)) {
      result = back_to(best, stalled, result.status);
      break;
    }
  }
  return outcome;
}

// Follows the barrier from strong to weak. Returns whether there is one. unit: weight at which the
// symmetric Dirichlet energy equals the energy.
bool StallRemedies::step_aside(double unit) {
  MapDomain& domain = problem_.domain();
  const bool strong = barrier_of(problem_.setup().map.energy) == Barrier::Strong;
  bool followed = false;
  follow_barrier(rules().barrier_weights, [&](double mu) {
    if (!domain.strengthen(mu) && strong) return PathEnd::Ended;
    if (!std::exchange(followed, true)) record_.mark(Remedy::FollowBarrier);
    return approach_with(strong ? 0 : mu * unit) ? PathEnd::None : PathEnd::Ended;
  });
  if (!followed) return false;
  domain.strengthen(0);
  problem_.rebuild();
  return true;
}

// Minimizes with this weight of the symmetric Dirichlet energy. Returns whether to continue.
bool StallRemedies::approach_with(double weight) {
  DegreeSetup with = problem_.setup();
  if (weight > 0) with.map.energy.push_back({symmetric_dirichlet(), weight});
  with.solve.curvature = Curvature::Projected;
  with.requested_energy = [this](VecIn x) {
    const auto& requested = problem_.setup().requested_energy;
    return requested ? requested(x) : problem_.own_energy(x);
  };
  // Points that only deep certificates prove are feasible in this solve, too.
  with.solve.injectivity_depth = problem_.depth();
  try {
    const Vec from = problem_.x();
    DegreeProblem inner(with, problem_.domain(), problem_.space(), from, problem_.bounds());
    const SolveResult result = approach(inner, rules().barrier_tolerance, Phase::Barrier, record_);
    problem_.take_point(inner);
    problem_.add_proven(inner.proven());
    return result.status == Status::Converged || result.status == Status::Stalled;
  } catch (const Stopped&) {  // before the first step
    return false;
  }
}

}  // namespace

SolveResult descend_with_remedies(DegreeProblem& problem, RemedyState& state, RunRecord& record) {
  return StallRemedies(problem, state, record).exhaust(kRemedies, state.counts);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
