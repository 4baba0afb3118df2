#include "majorant/parametrization/drive/internal/degree_solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "majorant/framework/evaluator.h"
#include "majorant/parametrization/drive/internal/solver_rules.h"

namespace majorant {
namespace {

constexpr double kAnyDecrease = -std::numeric_limits<double>::infinity();
constexpr int kNoLimit = std::numeric_limits<int>::max();

constexpr double kExcludedWeight = 1e-6;  // method.md section 9
constexpr int kExcludedIterations = 10;
constexpr double kExcludedTolerance = 1e-3;
constexpr int kStallRounds = 60;
constexpr double kIsometry = 4;  // symmetric Dirichlet density
constexpr double kBarrierTolerance = 1e-4;
// Of the barrier to follow, relative to the energy.
constexpr std::array kBarrierWeights{1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6};
// A second time helps where the first did (creature, ARAP, degree 2, fixed boundary: 0.64 instead
// of a stall), a third one has not been seen to.
constexpr int kBarrierRounds = 3;
constexpr double kWorthAnotherRound = 1e-4;  // of the energy

void add_use(RemedyUses& uses, Remedy remedy, double gained) {
  RemedyUse& use = uses[static_cast<std::size_t>(remedy)];
  ++use.runs;
  use.gained += gained;
}

}  // namespace

DegreeSolver::DegreeSolver(const Setup& setup, MapDomain& domain,
                           std::shared_ptr<const BezierTriangleSpace> space, const Vec& x)
    : setup_(setup),
      domain_(domain),
      space_(std::move(space)),
      start_(x),
      levels_(optimizer_ladder(space_->degree(), setup.solve.quadrature_points),
              space_->element_count()),
      terms_(energy_terms(setup.map, space_, levels_.rules())),
      depth_(setup.solve.injectivity_depth),
      injectivity_(std::make_shared<const LocalInjectivity>(space_, 2 * setup.map.rest.measure,
                                                            depth_, setup.stop)),
      element_weight_(Vec::Ones(space_->element_count())),
      x_(domain.unknowns(x)),
      built_([&] {
        require_curvature(terms_, setup.solve.curvature);
        setup.stop.poll();
        MapProblem built = domain.build(input(), x_);
        setup.stop.poll();  // what follows is the analysis of its pattern
        return built;
      }()),
      stepper_(built_.problem, newton_options(setup.solve.curvature, setup.stop)) {}

DomainInput DegreeSolver::input() const {
  return {setup_.map, space_, start_, terms_, injectivity_, depth_, setup_.stop};
}

double DegreeSolver::constraint_residual() const {
  double residual = 0;
  built_.problem.reduce(x_, &residual);
  return residual;
}

std::vector<long> DegreeSolver::proven() const {
  std::vector<long> counts(at(std::clamp(depth_, 0, LocalInjectivity::kMaxDepth)) + 1);
  add_counts(counts, stepper_.evaluator().counters().proven);
  add_counts(counts, proven_inside_);
  return counts;
}

void DegreeSolver::rebuild() {
  built_ = domain_.build(input(), x_);
  apply_state();
}

void DegreeSolver::apply_state() {
  built_.problem = built_.problem.with(
      energy_states(setup_.map, built_.energies, levels_.of_faces(), element_weight_));
  follow();
  stepper_.reset(built_.problem);
}

// Whether the domain has states that follow x; the stepper does not know them yet.
bool DegreeSolver::follow() {
  TermChanges changes = domain_.before_step(built_, x_, setup_.stop);
  if (changes.empty()) return false;
  built_.problem = built_.problem.with(std::move(changes));
  return true;
}

void DegreeSolver::return_to(const Place& place) {
  x_ = place.x;
  if (!place.surroundings) return;
  domain_.restore(place.surroundings);
  rebuild();
}

// Of the map alone, on the rules and with the weights of now.
double DegreeSolver::own_energy(VecIn x) const {
  const Vec& measure = setup_.map.rest.measure;
  const Vec map = x.head(2 * space_->node_count());
  double energy = energy_by_face(setup_.map, terms_, levels_.of_faces(), map).sum();
  for (const FixedPoint& handle : setup_.map.handles)
    energy += setup_.map.handle_weight *
              (map.segment<2>(2 * handle.node) - handle.position).squaredNorm();
  return energy / measure.sum();
}

// One step and what the domain makes of it; energy: of the problem, result.energy: the map's own.
DegreeSolver::Iteration DegreeSolver::iterate(SolveResult& result, double& energy,
                                              const Observer& observer) {
  Iteration it;
  it.step = stepper_.step(result.y, energy);
  if (it.step.outcome == StepResult::Outcome::Stopped) return it;
  result.newton_decrement = it.step.record.newton_decrement;
  result.blocking = it.step.blocking;
  const bool moved = it.step.outcome == StepResult::Outcome::Moved;
  if (moved) {
    x_ = built_.problem.expand(result.y);
    IterationRecord own = it.step.record;
    own.iteration = static_cast<int>(result.iterations.size()) + 1;
    own.energy = energy - domain_.foreign_energy(built_.problem, x_);
    own.relative_decrease = relative_to(result.energy, result.energy - own.energy);
    result.energy = own.energy;
    result.iterations.push_back(own);
    it.directive = observer(own, result.y);
  }
  DomainChange change = domain_.after_step(x_, it.step, input());
  if (change == DomainChange::Structure || (!moved && change == DomainChange::Values))
    it.since = StoppingTest::Since::ProblemChanged;
  if (change == DomainChange::Structure) {
    rebuild();
  } else if (follow()) {
    stepper_.reset(built_.problem);
    change = DomainChange::Values;
  }
  if (change == DomainChange::None) return it;
  result.y = built_.problem.reduce(x_);
  energy = stepper_.evaluator().value(result.y);
  return it;
}

void DegreeSolver::iterate_until(StoppingTest& test, const Observer& observer, double energy,
                                 SolveResult& result) {
  Place anchor = place();
  double anchor_energy = result.energy;
  std::optional<Stop> stop;
  while (!(stop = test.before_step())) {
    const Iteration it = iterate(result, energy, observer);
    const Advice advice = test.after(it.step, it.since);
    if ((stop = advice.stop)) break;
    if (advice.polish) stepper_.polish();
    if (advice.anchor) {
      anchor = place();
      anchor_energy = result.energy;
    }
    if (it.directive != Directive::Continue) throw Stopped(it.directive);
  }
  if (stop->at_anchor) {
    return_to(anchor);
    result.energy = anchor_energy;
  }
  result.status = stop->status;
  result.message = std::move(stop->message);
}

// Newton steps until the rules say so, from x_ to x_.
SolveResult DegreeSolver::descend(StoppingRules rules, Phase phase, RunRecord& record) {
  rules.max_iterations = std::min(rules.max_iterations, record.iterations_left());
  SolveResult result;
  try {
    if (follow()) stepper_.reset(built_.problem);
    result.y = built_.problem.reduce(x_);
    x_ = built_.problem.expand(result.y);
    if (!check_start(stepper_.evaluator(), result)) return result;
    const double energy = result.energy;
    result.energy -= domain_.foreign_energy(built_.problem, x_);
    began_at_ = result.energy;
    StoppingTest test(rules, energy);
    iterate_until(test, record.observer(space_->degree(), phase), energy, result);
  } catch (const Stopped& stop) {
    result = stopped(std::move(result), stop.why());
  }
  result.y = built_.problem.reduce(x_);
  return result;
}

void DegreeSolver::soften_start(RunRecord& record) {
  try {
    soften(record);
  } catch (const Stopped&) {  // so will be what follows
  }
}

void DegreeSolver::soften(RunRecord& record) {
  x_ = built_.problem.expand(built_.problem.reduce(x_));
  if (record.directive() != Directive::Continue) return;
  const Observer observe = record.observer(space_->degree(), Phase::SoftStart);
  StoppingTest test(brief_rules(record.iterations_left(), kAnyDecrease), 0);
  SolveResult result;
  bool softened = false;
  while (!test.before_step()) {
    const Vec weight = soft_weights(energy_by_face(setup_.map, terms_, levels_.of_faces(), x()),
                                    setup_.map.rest.measure);
    if (weight.size() == 0) break;
    element_weight_ = weight;
    softened = true;
    apply_state();
    result.y = built_.problem.reduce(x_);
    double energy = stepper_.evaluator().value(result.y);
    result.energy = energy - domain_.foreign_energy(built_.problem, x_);
    const Iteration it = iterate(result, energy, observe);
    if (test.after(it.step, it.since).stop || it.directive != Directive::Continue) break;
  }
  if (!softened) return;
  element_weight_.setOnes();
  apply_state();
}

SolveResult DegreeSolver::approach(double tolerance, RunRecord& record, Phase phase) {
  StoppingRules rules;
  rules.relative_decrease = tolerance;
  rules.stall_decrement = std::numeric_limits<double>::infinity();
  rules.max_iterations = kNoLimit;
  return descend(rules, phase, record);
}

StoppingRules DegreeSolver::final_rules() const {
  StoppingRules rules;
  rules.relative_decrease = domain_.part_of_tolerance() * setup_.solve.tolerance;
  rules.max_iterations = kNoLimit;
  return rules;
}

SolveResult DegreeSolver::finish(RunRecord& record) { return exhaust(kRemedies, record); }

// Runs again as long as a stall can be left or the quadrature be refined.
SolveResult DegreeSolver::exhaust(std::span<const Remedy> remedies, RunRecord& record) {
  SolveResult result = descend(final_rules(), Phase::Newton, record);
  try {
    for (int stalls = 0, refinements = 0;;) {
      if (result.status == Status::Stalled && stalls++ < kStallRounds) {
        if (!relieve(remedies, result, record)) return result;
      } else if (result.status == Status::Converged && refinements++ < kAccuracyRounds &&
                 refine_inaccurate()) {
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
  if (depth_ >= kDeepestBisection) return Effect::None;
  setup_.stop.poll();
  depth_ = std::min(depth_ + kBisectionsDeeper, kDeepestBisection);
  injectivity_ = std::make_shared<const LocalInjectivity>(space_, 2 * setup_.map.rest.measure,
                                                          depth_, setup_.stop);
  rebuild();
  record.mark(Remedy::Deepen);
  return Effect::GoOn;
}

DegreeSolver::Effect DegreeSolver::refine(const std::vector<Index>& blocking, RunRecord& record) {
  std::vector<Index> faces;  // of the map; the domain looks after its own
  for (const Index e : blocking)
    if (e < space_->element_count()) faces.push_back(e);
  if (!levels_.refine(faces)) return Effect::None;
  apply_state();
  record.mark(Remedy::Refine);
  return Effect::GoOn;
}

// Refines the elements whose integrals are worst until the rest is within the bound.
bool DegreeSolver::refine_inaccurate() {
  if (setup_.solve.quadrature_points > 0) return false;
  const bool refined = levels_.refine_inaccurate(setup_.map, terms_, x(), setup_.stop);
  if (refined) apply_state();
  return refined;
}

// [MC20] Sec. 4.3: the blocking triangles lose their say for a few steps, not their positivity.
DegreeSolver::Effect DegreeSolver::exclude(SolveResult& result, RunRecord& record) {
  const SolveResult stalled = result;
  for (const Index e : stalled.blocking)
    if (e < element_weight_.size()) element_weight_[e] = kExcludedWeight;
  if (element_weight_.minCoeff() == 1) return Effect::None;
  record.mark(Remedy::Exclude);
  const Place best = place();
  apply_state();
  StoppingRules rules;
  rules.relative_decrease = kExcludedTolerance;
  rules.max_iterations = kExcludedIterations;
  descend(rules, Phase::Excluded, record);
  element_weight_.setOnes();
  apply_state();
  rules.max_iterations = kNoLimit;
  result = descend(rules, Phase::Newton, record);
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
  for (int round = 0; round < kBarrierRounds && result.status == Status::Stalled; ++round) {
    const SolveResult stalled = result;
    const Place best = place();
    if (!step_aside(std::abs(stalled.energy) / kIsometry, record)) break;
    effect = Effect::Ended;
    result = exhaust(std::span(kRemedies).first(static_cast<std::size_t>(Remedy::FollowBarrier)),
                     record);
    // On the same rules, which may have become finer on the way.
    const double before = own_energy(best.x), gained = before - own_energy(x_);
    add_use(uses_, Remedy::FollowBarrier, std::max(gained, 0.0));
    if (!(gained > 0)) result = back_to(best, stalled, result.status);
    if (!(gained > kWorthAnotherRound * before)) break;
  }
  return effect;
}

// Along the barrier, from strong to weak; whether there is one to follow. unit: weight of the
// symmetric Dirichlet energy that makes it as large as the energy.
bool DegreeSolver::step_aside(double unit, RunRecord& record) {
  const bool strong = barrier_of(setup_.map.energy) == Barrier::Strong;
  bool followed = false;
  for (const double mu : kBarrierWeights) {
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
  if (weight > 0) with.map.energy.push_back({symmetric_dirichlet(), weight});
  with.solve.curvature = Curvature::Projected;
  with.solve.injectivity_depth =
      depth_;  // what only deep certificates prove is feasible there, too
  try {
    DegreeSolver inner(with, domain_, space_, x());
    const SolveResult result = inner.approach(kBarrierTolerance, record, Phase::Barrier);
    x_ = inner.x_;
    add_counts(proven_inside_, inner.proven());
    return result.status == Status::Converged || result.status == Status::Stalled;
  } catch (const Stopped&) {  // before it began
    return false;
  }
}

}  // namespace majorant
