// The remedies of a DegreeSolver (degree_solver.h): what is done about a run that is held at the
// limit of the feasible set. They are tried in the order of kRemedies; after one that changes
// something the run goes on.
#include <algorithm>
#include <cmath>
#include <utility>

#include "majorant/energies/densities/symmetric_dirichlet.h"
#include "majorant/parametrization/drive/internal/degree_solver.h"
#include "majorant/parametrization/drive/internal/solver_rules.h"

namespace majorant {
namespace {

class Detour {
 public:
  explicit Detour(int& count) : count_(count) { ++count_; }
  ~Detour() { --count_; }
  Detour(const Detour&) = delete;
  Detour& operator=(const Detour&) = delete;

 private:
  int& count_;
};

// The symmetric Dirichlet density of isometries.
double least_density() { return symmetric_dirichlet_density().value({1.0, 0.0, 0.0, 0.0}); }

void add_use(RemedyUses& uses, Remedy remedy, double gained) {
  RemedyUse& use = uses[static_cast<std::size_t>(remedy)];
  ++use.runs;
  use.gained += gained;
}

}  // namespace

SolveResult DegreeSolver::finish(RunRecord& record) {
  const auto solve = [&] {
    return added_.bounded() ? solve_within_bounds(record) : exhaust(kRemedies, tries_, record);
  };
  SolveResult result = solve();
  if (result.status == Status::Stalled && domain_.hold()) result = solve();
  record.forget_mark();  // the last remedy may have had no iteration
  return result;
}

// Runs again as long as a stall can be left or the quadrature be refined.
SolveResult DegreeSolver::exhaust(std::span<const Remedy> remedies, Tries& tries,
                                  RunRecord& record) {
  SolveResult result = descend(final_rules(), Phase::Newton, record);
  try {
    for (;;) {
      if (result.status == Status::Stalled && tries.stalls++ < rules().stall_rounds) {
        if (!relieve(remedies, result, record)) return result;
      } else if (result.status == Status::Converged &&
                 tries.refinements++ < setup_.rules.accuracy_rounds && refine_inaccurate()) {
        result = descend(final_rules(), Phase::Newton, record);
      } else {
        return result;
      }
    }
  } catch (const Stopped& stop) {
    return stopped(std::move(result), stop.why());
  }
}

// The first remedy that changes something, and the run after it. Whether there was one.
bool DegreeSolver::relieve(std::span<const Remedy> remedies, SolveResult& result,
                           RunRecord& record) {
  for (const Remedy remedy : remedies) {
    const double before = result.energy;
    const Effect effect = apply(remedy, result, record);
    if (was_stopped(result.status) || effect == Effect::Ended) return false;
    if (effect == Effect::None) continue;
    const double gained = before - result.energy;
    result = descend(final_rules(), Phase::Newton, record);
    add_use(uses_, remedy, gained + began_at_ - result.energy);
    return true;
  }
  return false;
}

DegreeSolver::Effect DegreeSolver::apply(Remedy remedy, SolveResult& result, RunRecord& record) {
  const Detour detour(detours_);
  switch (remedy) {
    case Remedy::Deepen:
      return deepen(record);
    case Remedy::Refine:
      return refine(result.blocking, record);
    case Remedy::Exclude:
      return exclude(result, record);
    case Remedy::FollowBarrier:
      return follow_barrier(result, record);
  }
  return Effect::None;
}

// The certificate may be too coarse rather than the map too close to degenerate: bisect deeper.
DegreeSolver::Effect DegreeSolver::deepen(RunRecord& record) {
  if (depth_ >= rules().deepest_bisection) return Effect::None;
  setup_.stop.poll();
  set_depth(std::min(depth_ + rules().bisections_deeper, rules().deepest_bisection));
  record.mark(Remedy::Deepen);
  return Effect::GoOn;
}

void DegreeSolver::set_depth(int depth) {
  depth_ = depth;
  injectivity_ = std::make_shared<const LocalInjectivity>(space_, 2 * setup_.map.rest.measure,
                                                          depth_, setup_.stop);
  rebuild();
}

DegreeSolver::Effect DegreeSolver::refine(const std::vector<Index>& blocking, RunRecord& record) {
  std::vector<Index> faces;  // of the map; the domain looks after its own
  for (const Index e : blocking)
    if (e < space_->element_count()) faces.push_back(e);
  if (!ranks().any(levels_.refine(faces))) return Effect::None;
  apply_state();
  record.mark(Remedy::Refine);
  return Effect::GoOn;
}

// [MC20] Sec. 4.3: the blocking triangles lose their say for a few steps, not their positivity.
DegreeSolver::Effect DegreeSolver::exclude(SolveResult& result, RunRecord& record) {
  const SolveResult stalled = result;
  for (const Index e : stalled.blocking)
    if (e < element_weight_.size()) element_weight_[e] = rules().excluded_weight;
  if (ranks().all((element_weight_.array() == 1).all())) return Effect::None;
  record.mark(Remedy::Exclude);
  const Place best = place();
  apply_state();
  StoppingRules brief = unlimited(rules().excluded_tolerance);
  brief.max_iterations = rules().excluded_iterations;
  descend(brief, Phase::Excluded, record);
  element_weight_.setOnes();
  apply_state();
  result = descend(unlimited(rules().excluded_tolerance), Phase::Newton, record);
  if (result.energy < stalled.energy) return Effect::GoOn;
  result = back_to(best, stalled, result.status);
  add_use(uses_, Remedy::Exclude, 0);
  return Effect::None;
}

// A way out that led nowhere, or was stopped before it led anywhere.
SolveResult DegreeSolver::back_to(const Place& best, SolveResult stalled, Status way_out) {
  return_to(best);
  if (!was_stopped(way_out)) return stalled;
  return stopped(std::move(stalled),
                 way_out == Status::TimeLimit ? Directive::TimeLimit : Directive::Interrupt);
}

// Interior points: the energy plus mu times one whose barrier is strong, for falling mu, leads
// around corners that a weak barrier, or none, ran into. The map's is symmetric Dirichlet, unless
// that is in its energy; the surroundings bring their own.
DegreeSolver::Effect DegreeSolver::follow_barrier(SolveResult& result, RunRecord& record) {
  if (std::exchange(barrier_followed_, true)) return Effect::None;
  Effect effect = Effect::None;
  for (int round = 0; round < rules().barrier_rounds && result.status == Status::Stalled; ++round) {
    const SolveResult stalled = result;
    const Place best = place();
    if (!step_aside(std::abs(stalled.energy) / least_density(), record)) break;
    effect = Effect::Ended;
    Tries tries;
    result = exhaust(std::span(kRemedies).first(static_cast<std::size_t>(Remedy::FollowBarrier)),
                     tries, record);
    // On the same rules, which may have become finer on the way.
    const double before = own_energy(best.x), gained = before - own_energy(x_);
    add_use(uses_, Remedy::FollowBarrier, std::max(gained, 0.0));
    if (!(gained > 0)) result = back_to(best, stalled, result.status);
    if (!(gained > rules().worth_another_round * before)) break;
  }
  return effect;
}

// Along the barrier, from strong to weak; whether there is one to follow. unit: weight of the
// symmetric Dirichlet energy that makes it as large as the energy.
bool DegreeSolver::step_aside(double unit, RunRecord& record) {
  const bool strong = barrier_of(setup_.map.energy) == Barrier::Strong;
  bool followed = false;
  for (const double mu : rules().barrier_weights) {
    if (!domain_.strengthen(mu) && strong) break;
    if (!std::exchange(followed, true)) record.mark(Remedy::FollowBarrier);
    if (!approach_with(strong ? 0 : mu * unit, record)) break;
  }
  if (!followed) return false;
  domain_.strengthen(0);
  rebuild();
  return true;
}

// Minimizes with that much of the symmetric Dirichlet energy; whether to go on.
bool DegreeSolver::approach_with(double weight, RunRecord& record) {
  Setup with = setup_;
  with.added = added_;
  if (weight > 0) with.map.energy.push_back({symmetric_dirichlet(), weight});
  with.solve.curvature = Curvature::Projected;
  with.asked_energy = [this](VecIn x) {
    return setup_.asked_energy ? setup_.asked_energy(x) : own_energy(x);
  };
  with.solve.injectivity_depth =
      depth_;  // what only deep certificates prove is feasible there, too
  try {
    DegreeSolver inner(with, domain_, space_, x());
    const SolveResult result = inner.approach(rules().barrier_tolerance, record, Phase::Barrier);
    x_ = inner.x_;
    add_counts(proven_inside_, inner.proven());
    return result.status == Status::Converged || result.status == Status::Stalled;
  } catch (const Stopped&) {  // before it began
    return false;
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
