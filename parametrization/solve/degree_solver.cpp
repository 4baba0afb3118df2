#include "majorant/parametrization/solve/degree_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "majorant/elements/jacobian_net.h"
#include "majorant/energies/densities/symmetric_dirichlet.h"
#include "majorant/framework/element_values.h"
#include "majorant/framework/energy_term.h"
#include "majorant/framework/error.h"
#include "majorant/framework/problem.h"
#include "majorant/framework/problem_parts.h"
#include "majorant/framework/projection.h"
#include "majorant/framework/stopwatch.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/parametrization/solve/solver_rules.h"

namespace majorant {
namespace {

// Returns the solver that the options make for this problem; the stepper's constructor calls it.
SolverFactory solver_of(const SolveOptions& options, const Problem& problem,
                        const DirectSolverOptions& direct) {
  if (!options.linear_solver) return {};
  return [&options, &problem, direct] { return options.linear_solver(problem.pattern(), direct); };
}

BarrierProblem::Bounds bounds_of(const std::shared_ptr<const MapExtension>& added) {
  BarrierProblem::Bounds bounds;
  if (added)
    for (const auto& checker : added->checkers())
      if (auto bound = std::dynamic_pointer_cast<const BarrierChecker>(checker))
        bounds.push_back(std::move(bound));
  return bounds;
}

// What was prepared for a solve from x; null: nothing, or for another one.
std::shared_ptr<PreparedParts> prepared_for(MapDomain& domain, const BezierTriangleSpace& space,
                                            const Vec& x) {
  std::shared_ptr<PreparedParts> prepared = domain.take_prepared();
  return prepared && prepared->fits(space, x) ? prepared : nullptr;
}

// The map's energy keeps its weight, so that its scaffold, its rules and its trace know it.
double weight_beside_map(const BarrierStage::Bound& bound, const BarrierStage& stage) {
  return bound.weight / stage.energy;
}

void require_curvature(const MapExtension& added, const BarrierProblem::Bounds& bounds,
                       Curvature asked) {
  const auto require = [asked](const EnergyTerm& term) {
    if (!term.supports(asked))
      throw InvalidArgument(
          fmt::format("term '{}' has no curvature model '{}'", term.name(), curvature_name(asked)));
  };
  for (const auto& one : added.terms()) require(*one.term);
  for (const auto& bound : bounds) {
    require(*bound->barrier());
    if (const auto* measure = dynamic_cast<const ViolationMeasure*>(bound.get()))
      require(*measure->violation(0));
  }
}

}  // namespace

DegreeSolver::DegreeSolver(const Setup& setup, MapDomain& domain,
                           std::shared_ptr<const BezierTriangleSpace> space, const Vec& x)
    : DegreeSolver(setup, domain, space, x, {bounds_of(setup.map.added), {}},
                   prepared_for(domain, *space, x)) {}

DegreeSolver::DegreeSolver(const Setup& setup, MapDomain& domain,
                           std::shared_ptr<const BezierTriangleSpace> space, const Vec& x,
                           Bounds bounds, std::shared_ptr<PreparedParts> prepared)
    : setup_(setup),
      domain_(domain),
      space_(std::move(space)),
      start_(x),
      levels_(
          optimizer_ladder(space_->degree(), setup.solve.quadrature_points, setup.rules.quadrature),
          space_->element_count()),
      terms_(prepared ? prepared->terms : energy_terms(setup.map, space_, levels_.rules())),
      depth_(setup.solve.injectivity_depth),
      injectivity_(prepared ? prepared->injectivity
                            : std::make_shared<const LocalInjectivity>(
                                  space_, 2 * setup.map.rest->measure, depth_, setup.stop)),
      x_(domain.unknowns(x)),
      bounds_(std::move(bounds)),
      prepared_(std::move(prepared)),
      built_([&] {
        require_curvature(terms_, setup.solve.curvature.model);
        if (setup.map.added)
          require_curvature(*setup.map.added, bounds_.all, setup.solve.curvature.model);
        setup.stop.poll();
        MapProblem built = prepared_ ? prepared_->built : build();
        setup.stop.poll();  // what follows is the analysis of its pattern
        return built;
      }()),
      stepper_(built_.problem, [&] {
        const DirectSolverOptions direct{.ordering = domain.ordering(),
                                         .analysis = prepared_ ? prepared_->analysis : nullptr};
        return newton_options(setup.solve.curvature, setup.rules, setup.stop, direct,
                              solver_of(setup.solve, built_.problem, direct));
      }()) {
  prepared_.reset();
  if (setup.map.added && !setup.map.added->constraints().empty()) meet_added_constraints();
}

// What stands in place of the bounds is held, and has its terms.
MapProblem DegreeSolver::build() {
  const auto in = [this](const MapSpecification& map) {
    return domain_.build(map, space_, start_, terms_, injectivity_, x_);
  };
  if (bounds_.all.empty()) return in(setup_.map);
  const BarrierStage& stage = bounds_.stage;
  std::vector<std::shared_ptr<const FeasibilityChecker>> checkers;
  for (const auto& checker : setup_.map.added->checkers())
    if (!std::dynamic_pointer_cast<const BarrierChecker>(checker)) checkers.push_back(checker);
  for (const auto& instead : stage.bounds)
    if (instead.checker) checkers.push_back(instead.checker);
  MapExtension added = setup_.map.added->with(std::move(checkers));
  for (const auto& instead : stage.bounds)
    added.add(instead.term, weight_beside_map(instead, stage));
  MapSpecification map = setup_.map;
  map.added = std::make_shared<const MapExtension>(std::move(added));
  return in(map);
}

// The last terms that were added.
std::span<const TermId> DegreeSolver::barriers() const {
  return std::span(built_.added).last(bounds_.stage.bounds.size());
}

namespace {

// The stiffness of a displacement, relative to that of a unit edge: displacements that no edge
// feels stay small. Far below what edges cost, far above rounding.
constexpr double kAnchor = 1e-6;
// The accuracy of a projected start. It needs no more digits, and takes more steps, since nothing
// preconditions it.
constexpr ProjectionRules kRough{.enough = 1e-16, .most_steps = 2000};

// d -> (L + kAnchor) d, L the graph Laplacian of the edges between neighbouring control points;
// unknowns beyond the map's have unit weight.
class Stiffness {
 public:
  explicit Stiffness(const BezierTriangleSpace& space)
      : triangles_(control_triangles(space)), map_size_(2 * space.node_count()) {}

  Vec operator*(const Vec& d) const {
    Vec out = d;
    out.head(map_size_) *= kAnchor;
    for (Index t = 0; t < triangles_.rows(); ++t)
      for (int k = 0; k < 3; ++k) {
        const Index a = triangles_(t, k), b = triangles_(t, next(k));
        const Vector2 edge = d.segment<2>(2 * a) - d.segment<2>(2 * b);
        out.segment<2>(2 * a) += edge;
        out.segment<2>(2 * b) -= edge;
      }
    return out;
  }

 private:
  Cells triangles_;
  Index map_size_;
};

// x moved to where it satisfies the constraints, as smoothly as they allow: a translation costs
// nothing, and what one point must move its neighbours share. x: full unknowns, the nodes of
// `space` first. Nothing is known of injectivity afterwards.
Vec meet_constraints(const Problem& problem, const BezierTriangleSpace& space, VecIn x) {
  return problem.expand(projection(ProblemParts::elimination(problem), x, Stiffness(space),
                                   Vec::Ones(problem.size()), kRough));
}

}  // namespace

// Moves the start to where it meets added constraints, which may hold nowhere yet.
void DegreeSolver::meet_added_constraints() {
  x_ = meet_constraints(built_.problem, *space_, x_);
  const Verdict faces = injectivity_->check(x());
  if (!faces.feasible)
    throw Error(ErrorKind::Infeasible,
                fmt::format("degree {}: the start, moved to where it satisfies the added "
                            "constraints, is not injective: face {} ({} in all) is not positively "
                            "oriented; bring a start that satisfies them",
                            space_->degree(), faces.blocking.front(), faces.blocking.size()));
  if (!AngleSums(space_, AngleSums::Vertices::Interior, setup_.map.seams).check(x()).feasible)
    throw Error(ErrorKind::Infeasible,
                fmt::format("degree {}: the start, moved to where it satisfies the added "
                            "constraints, covers a place more than once; bring a start that "
                            "satisfies them",
                            space_->degree()));
}

double DegreeSolver::constraint_residual() const {
  double residual = 0;
  built_.problem.reduce(x_, &residual);
  return residual;
}

std::vector<long> DegreeSolver::proven() const {
  std::vector<long> counts(to_size(std::clamp(depth_, 0, LocalInjectivity::kMaxDepth)) + 1);
  add_counts(counts, stepper_.evaluator().counters().proven);
  add_counts(counts, proven_inside_);
  return counts;
}

void DegreeSolver::rebuild() {
  built_ = build();
  renew_states();
  Stopwatch analysis;
  stepper_.reset(built_.problem);
  domain_.charge(analysis.restart());
}

void DegreeSolver::apply_state() {
  renew_states();
  stepper_.reset(built_.problem);
}

void DegreeSolver::renew_states() {
  built_.problem = built_.problem.with(
      energy_states(setup_.map, built_.energies, levels_.of_faces(), element_weight_));
  follow();
}

// Returns whether the domain has states that follow x; the stepper does not know them yet.
bool DegreeSolver::follow() {
  TermChanges changes = domain_.before_step(built_, x_);
  if (changes.empty()) return false;
  built_.problem = built_.problem.with(std::move(changes));
  return true;
}

void DegreeSolver::return_to(const Checkpoint& checkpoint) {
  x_ = checkpoint.x;
  if (!checkpoint.surroundings) return;
  domain_.restore(checkpoint.surroundings);
  rebuild();
}

// The energy of the map alone on the present rules, all elements at their full weight, and of the
// terms that were added.
double DegreeSolver::own_energy(VecIn x) const {
  return energy_of_map(setup_.map, terms_, levels_.of_faces(), x.head(2 * space_->node_count()));
}

// The part of the problem's energy at x_ that nobody asked for.
double DegreeSolver::foreign_energy() const {
  double sum = domain_.foreign_energy(built_.problem, x_);
  for (const TermId id : barriers()) sum += term_energy(built_.problem, id, x_);
  return sum;
}

// own: the step's record, of the map alone.
Directive DegreeSolver::note(const IterationRecord& own, StepResult::Outcome outcome, Phase phase,
                             RunRecord& record) const {
  TraceEntry row;
  row.degree = space_->degree();
  row.record = own;
  row.phase = phase;
  row.outcome = outcome;
  row.energy = own.energy;
  if (phase != Phase::Newton)
    row.energy = setup_.asked_energy ? setup_.asked_energy(x()) : own_energy(x_);
  Directive directive = record.note(std::move(row));
  if (setup_.watch) {
    const Directive watched = setup_.watch(record.trace().back(), {space_, x(), {}});
    if (directive == Directive::Continue) directive = watched;
  }
  return directive;
}

// Steps on the problem of a domain. result.energy and the iterations are the map's own.
class DegreeSolver::MapDescent : public Descent {
 public:
  MapDescent(DegreeSolver& solver, Phase phase, RunRecord& record)
      : solver_(solver), phase_(phase), record_(record) {}

  Answer after_step(const StepResult& step) override;
  void set_fallback() override {
    fallback_ = solver_.checkpoint();
    fallback_energy_ = result.energy;
  }
  void return_to_fallback() override {
    solver_.return_to(fallback_);
    result.energy = fallback_energy_;
  }

 protected:
  // result.y and energy are those of the solver's problem and unknowns.
  void follow_problem() {
    result.y = solver_.built_.problem.reduce(solver_.x_);
    energy = solver_.stepper_.evaluator().value(result.y);
  }

  DegreeSolver& solver_;

 private:
  Phase phase_;
  RunRecord& record_;
  Checkpoint fallback_;
  double fallback_energy_ = 0;
};

Descent::Answer DegreeSolver::MapDescent::after_step(const StepResult& step) {
  const bool moved = step.outcome == StepResult::Outcome::Moved;
  IterationRecord own = step.record;
  if (moved) {
    solver_.x_ = solver_.built_.problem.expand(result.y);
    own.energy = energy - solver_.foreign_energy();
    own.relative_decrease = relative_to(result.energy, result.energy - own.energy);
    result.energy = own.energy;
    result.iterations.back() = own;
  }
  own.energy = result.energy;
  Answer answer;
  if (solver_.variables() > 0) answer.directive = solver_.note(own, step.outcome, phase_, record_);
  DomainChange change = solver_.domain_.after_step(solver_.x_, step, solver_.depth_);
  if (change == DomainChange::Structure || change == DomainChange::Deferred ||
      (!moved && change == DomainChange::Values))
    answer.since = StoppingTest::Since::ProblemChanged;
  if (change == DomainChange::Structure) {
    solver_.rebuild();
  } else if (solver_.follow()) {
    solver_.stepper_.reset(solver_.built_.problem);
    change = DomainChange::Values;
  }
  if (change == DomainChange::Values || change == DomainChange::Structure) follow_problem();
  return answer;
}

// Takes every step on the energy as the last one's faces have weighted it; ends where none is
// stiff.
class DegreeSolver::SoftStart final : public MapDescent {
 public:
  SoftStart(DegreeSolver& solver, RunRecord& record)
      : MapDescent(solver, Phase::SoftStart, record) {}

  // Returns whether the start is to be a soft one.
  bool weigh() {
    std::optional<Vec> weight = solver_.soft_weights();
    if (!weight) return false;
    solver_.element_weight_ = *std::move(weight);
    solver_.apply_state();
    follow_problem();
    result.energy = energy - solver_.foreign_energy();
    return true;
  }
  Answer after_step(const StepResult& step) override {
    Answer answer = MapDescent::after_step(step);
    if (!weigh()) answer.directive = Directive::Interrupt;  // of this descent alone
    return answer;
  }
};

// Newton steps until the rules say so, from x_ to x_.
SolveResult DegreeSolver::descend(StoppingRules rules, Phase phase, RunRecord& record) {
  rules.max_iterations = std::min(rules.max_iterations, record.iterations_left());
  MapDescent descent(*this, phase, record);
  SolveResult& result = descent.result;
  try {
    if (follow()) stepper_.reset(built_.problem);
    result.y = built_.problem.reduce(x_);
    x_ = built_.problem.expand(result.y);
    if (!check_start(stepper_.evaluator(), result)) return std::move(result);
    descent.energy = result.energy;
    result.energy -= foreign_energy();
    began_at_ = result.energy;
    stepper_.descend(descent, rules);
  } catch (const Stopped& stop) {
    result = stopped(std::move(result), stop.why());
  }
  result.y = built_.problem.reduce(x_);
  return std::move(result);
}

void DegreeSolver::soft_start(RunRecord& record) {
  if (soft_started_) return;
  try {
    take_soft_steps(record);
    soft_started_ = record.directive() == Directive::Continue;
  } catch (const Stopped&) {  // so will be what follows
  }
}

void DegreeSolver::take_soft_steps(RunRecord& record) {
  x_ = built_.problem.expand(built_.problem.reduce(x_));
  if (record.directive() != Directive::Continue) return;
  SoftStart descent(*this, record);
  if (!descent.weigh()) return;
  stepper_.descend(descent, brief_rules(record.iterations_left(), kAnyDecrease));
  element_weight_ = Vec();
  apply_state();
}

// Weights of the faces of a start of enormous energy, whose mean density is soft_start or more (a
// Tutte map with nearly collapsed triangles); none for others. sqrt is concave, so weights
// 1 / sqrt(density) give a linear majorizer of sqrt: each step on the reweighted energy decreases
// sum A sqrt(density).
std::optional<Vec> DegreeSolver::soft_weights() const {
  const Vec energy = energy_by_face(setup_.map, terms_, levels_.of_faces(), x());
  const Vec& measure = setup_.map.rest->measure;
  const double all = partition().sum(energy.sum());
  if (!(all >= setup_.rules.soft_start * partition().sum(measure.sum())) ||
      !partition().all(energy.allFinite()))
    return {};
  return energy.cwiseQuotient(measure).cwiseSqrt().cwiseInverse();
}

SolveResult DegreeSolver::approach(double tolerance, RunRecord& record, Phase phase) {
  StoppingRules rules = unlimited(tolerance);
  rules.stall_decrement = std::numeric_limits<double>::infinity();
  return descend(rules, phase, record);
}

// Ended by this decrease of one iteration, be it on a plateau, whatever the next one promises, by
// no number of iterations but the run's.
StoppingRules DegreeSolver::unlimited(double relative_decrease) const {
  StoppingRules rules = setup_.rules.stopping;
  rules.relative_decrease = relative_decrease;
  rules.last_factor = rules.plateau_factor = std::numeric_limits<double>::infinity();
  rules.max_iterations = std::numeric_limits<int>::max();
  return rules;
}

StoppingRules DegreeSolver::final_rules() const {
  StoppingRules rules = unlimited(setup_.solve.tolerance);
  rules.last_factor = setup_.rules.stopping.last_factor;
  rules.plateau_factor = setup_.rules.stopping.plateau_factor;
  return domain_.final_rules(rules);
}

IterationRecord DegreeSolver::try_step() {
  if (follow()) stepper_.reset(built_.problem);
  Vec y = built_.problem.reduce(x_);
  double energy = stepper_.evaluator().value(y);
  return stepper_.step(y, energy).record;
}

std::optional<DegreeSolver::State> DegreeSolver::state() const {
  if (running_remedies_ > 0) return std::nullopt;
  return State{soft_started_,
               remedy_counts_.stalls,
               remedy_counts_.refinements,
               barrier_followed_,
               depth_,
               levels_.of_faces(),
               uses_};
}

void DegreeSolver::resume(State state) {
  levels_.set(std::move(state.levels));
  soft_started_ = state.soft_started;
  remedy_counts_ = {state.stalls, state.refinements};
  barrier_followed_ = state.barrier_followed;
  uses_ = state.remedies;
  if (state.depth > depth_) set_depth(state.depth);
  apply_state();
}

// Refines the elements whose integrals are worst until the rest is within the bound.
bool DegreeSolver::refine_inaccurate() {
  if (setup_.solve.quadrature_points > 0) return false;
  const bool refined = levels_.refine_inaccurate(setup_.map, terms_, x(),
                                                 setup_.rules.quadrature.error, setup_.stop);
  if (refined) apply_state();
  return refined;
}

// ---- Remedies: what is done about a run that is held at the limit of the feasible set. They are
// tried in the order of kRemedies; after one that changes something the run goes on. ----

namespace {

class RunningRemedy {
 public:
  explicit RunningRemedy(int& count) : count_(count) { ++count_; }
  ~RunningRemedy() { --count_; }
  RunningRemedy(const RunningRemedy&) = delete;
  RunningRemedy& operator=(const RunningRemedy&) = delete;

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
    return bounds_.all.empty() ? exhaust(kRemedies, remedy_counts_, record)
                               : solve_within_bounds(record);
  };
  SolveResult result = solve();
  if (result.status == Status::Stalled && domain_.hold()) result = solve();
  record.forget_mark();  // the last remedy may have had no iteration
  return result;
}

// Runs again as long as a stall can be left or the quadrature be refined.
SolveResult DegreeSolver::exhaust(std::span<const Remedy> remedies, RemedyCounts& counts,
                                  RunRecord& record) {
  SolveResult result = descend(final_rules(), Phase::Newton, record);
  try {
    for (;;) {
      if (result.status == Status::Stalled && counts.stalls++ < rules().stall_rounds) {
        if (!relieve(remedies, result, record)) return result;
      } else if (result.status == Status::Converged &&
                 counts.refinements++ < setup_.rules.accuracy_rounds && refine_inaccurate()) {
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
    const RemedyOutcome outcome = apply(remedy, result, record);
    if (was_stopped(result.status) || outcome == RemedyOutcome::Ended) return false;
    if (outcome == RemedyOutcome::None) continue;
    const double gained = before - result.energy;
    result = descend(final_rules(), Phase::Newton, record);
    add_use(uses_, remedy, gained + began_at_ - result.energy);
    return true;
  }
  return false;
}

DegreeSolver::RemedyOutcome DegreeSolver::apply(Remedy remedy, SolveResult& result,
                                                RunRecord& record) {
  const RunningRemedy running(running_remedies_);
  switch (remedy) {
    case Remedy::Deepen:
      return deepen(record);
    case Remedy::Refine:
      return refine(result.blocking, record);
    case Remedy::Exclude:
      return exclude(result, record);
    case Remedy::FollowBarrier:
      return follow_strong_barrier(result, record);
  }
  return RemedyOutcome::None;
}

// The certificate may be too coarse rather than the map too close to degenerate: bisect deeper.
DegreeSolver::RemedyOutcome DegreeSolver::deepen(RunRecord& record) {
  if (depth_ >= rules().deepest_bisection) return RemedyOutcome::None;
  setup_.stop.poll();
  set_depth(std::min(depth_ + rules().bisections_deeper, rules().deepest_bisection));
  record.mark(Remedy::Deepen);
  return RemedyOutcome::GoOn;
}

void DegreeSolver::set_depth(int depth) {
  depth_ = depth;
  injectivity_ = std::make_shared<const LocalInjectivity>(space_, 2 * setup_.map.rest->measure,
                                                          depth_, setup_.stop);
  rebuild();
}

DegreeSolver::RemedyOutcome DegreeSolver::refine(const std::vector<Index>& blocking,
                                                 RunRecord& record) {
  std::vector<Index> faces;  // of the map; the domain looks after its own
  for (const Index e : blocking)
    if (e < space_->element_count()) faces.push_back(e);
  if (!partition().any(levels_.refine(faces))) return RemedyOutcome::None;
  apply_state();
  record.mark(Remedy::Refine);
  return RemedyOutcome::GoOn;
}

// [MC20] Sec. 4.3: the blocking triangles lose their say for a few steps, not their positivity.
DegreeSolver::RemedyOutcome DegreeSolver::exclude(SolveResult& result, RunRecord& record) {
  const SolveResult stalled = result;
  std::vector<Index> excluded;  // faces of the map
  for (const Index e : stalled.blocking)
    if (e < space_->element_count()) excluded.push_back(e);
  if (!partition().any(!excluded.empty())) return RemedyOutcome::None;
  element_weight_ = Vec::Ones(space_->element_count());
  for (const Index e : excluded) element_weight_[e] = rules().excluded_weight;
  record.mark(Remedy::Exclude);
  const Checkpoint best = checkpoint();
  apply_state();
  StoppingRules brief = unlimited(rules().excluded_tolerance);
  brief.max_iterations = rules().excluded_iterations;
  descend(brief, Phase::Excluded, record);
  element_weight_ = Vec();
  apply_state();
  result = descend(unlimited(rules().excluded_tolerance), Phase::Newton, record);
  if (result.energy < stalled.energy) return RemedyOutcome::GoOn;
  result = back_to(best, stalled, result.status);
  add_use(uses_, Remedy::Exclude, 0);
  return RemedyOutcome::None;
}

// A way out that led nowhere, or was stopped before it led anywhere.
SolveResult DegreeSolver::back_to(const Checkpoint& best, SolveResult stalled, Status way_out) {
  return_to(best);
  if (!was_stopped(way_out)) return stalled;
  return stopped(std::move(stalled),
                 way_out == Status::TimeLimit ? Directive::TimeLimit : Directive::Interrupt);
}

// Interior points: the energy plus mu times one whose barrier is strong, for falling mu, leads
// around corners that a weak barrier, or none, ran into. The map's is symmetric Dirichlet, unless
// that is in its energy; the surroundings bring their own.
DegreeSolver::RemedyOutcome DegreeSolver::follow_strong_barrier(SolveResult& result,
                                                                RunRecord& record) {
  if (std::exchange(barrier_followed_, true)) return RemedyOutcome::None;
  RemedyOutcome outcome = RemedyOutcome::None;
  for (int round = 0; round < rules().barrier_rounds && result.status == Status::Stalled; ++round) {
    const SolveResult stalled = result;
    const Checkpoint best = checkpoint();
    if (!step_aside(std::abs(stalled.energy) / least_density(), record)) break;
    outcome = RemedyOutcome::Ended;
    RemedyCounts counts;
    result = exhaust(std::span(kRemedies).first(static_cast<std::size_t>(Remedy::FollowBarrier)),
                     counts, record);
    // Both energies are on the same rules, which may have become finer on the way.
    const double gained = own_energy(best.x) - own_energy(x_);
    add_use(uses_, Remedy::FollowBarrier, std::max(gained, 0.0));
    if (!(gained > 0)) {
      result = back_to(best, stalled, result.status);
      break;
    }
  }
  return outcome;
}

// Along the barrier, from strong to weak; whether there is one to follow. unit: weight of the
// symmetric Dirichlet energy that makes it as large as the energy.
bool DegreeSolver::step_aside(double unit, RunRecord& record) {
  const bool strong = barrier_of(setup_.map.energy) == Barrier::Strong;
  bool followed = false;
  follow_barrier(rules().barrier_weights, [&](double mu) {
    if (!domain_.strengthen(mu) && strong) return PathEnd::Ended;
    if (!std::exchange(followed, true)) record.mark(Remedy::FollowBarrier);
    return approach_with(strong ? 0 : mu * unit, record) ? PathEnd::None : PathEnd::Ended;
  });
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
  with.asked_energy = [this](VecIn x) {
    return setup_.asked_energy ? setup_.asked_energy(x) : own_energy(x);
  };
  with.solve.injectivity_depth =
      depth_;  // what only deep certificates prove is feasible there, too
  try {
    const Vec from = x();
    DegreeSolver inner(with, domain_, space_, from, bounds_);
    const SolveResult result = inner.approach(rules().barrier_tolerance, record, Phase::Barrier);
    x_ = inner.x_;
    add_counts(proven_inside_, inner.proven());
    return result.status == Status::Converged || result.status == Status::Stalled;
  } catch (const Stopped&) {  // before it began
    return false;
  }
}

// ---- Bounds with a barrier: first as if there were none; where the free minimum meets them, it is
// the constrained one. Else BarrierMinimizer leads inside and along the barrier. ----

// This degree as BarrierMinimizer leads it.
class DegreeSolver::WithinBounds final : public BarrierProblem {
 public:
  WithinBounds(DegreeSolver& solver, SolveResult free, RunRecord& record)
      : result(std::move(free)), solver_(solver), record_(record) {}

  const Bounds& bounds() const override { return solver_.bounds_.all; }
  Evaluator& evaluator() override { return solver_.stepper_.evaluator(); }
  std::vector<TermId> barriers() const override {
    return {solver_.barriers().begin(), solver_.barriers().end()};
  }
  Vec y() const override { return solver_.built_.problem.reduce(solver_.x_); }
  Vec point() const override { return solver_.x(); }
  BarrierEnergies energies() const override {
    BarrierEnergies here{solver_.own_energy(solver_.x_), 0};
    for (const auto& bound : bounds()) here.barrier += values(*bound->barrier()).sum();
    return here;
  }
  // A barrier is a mean or a sum, of -log or not. What it gains while its weight falls tells what
  // it weighs; its values do for the first weight.
  double barrier_size(const BarrierStage& stage,
                      std::span<const BarrierPhase> phases) const override {
    if (phases.size() == 1) return 0;
    if (phases.size() > 1) {
      const BarrierPhase &last = phases.back(), &before = phases[phases.size() - 2];
      return std::max(last.barrier - before.barrier, 0.0) / std::log(before.mu / last.mu);
    }
    double size = 0;
    for (const auto& instead : stage.bounds)
      if (instead.checker) size += values(*instead.term).cwiseAbs().sum();
    return std::max(size, solver_.setup_.rules.bounds.least_barrier);
  }
  void enter(const BarrierStage& stage) override {
    solver_.setup_.stop.poll();
    solver_.enter(stage);
  }
  // A map may stall at the limit of its certificates, which ends a phase, too.
  SolveResult descend(StoppingRules rules) override {
    result = solver_.descend(solver_.unlimited(rules.relative_decrease), Phase::Barrier, record_);
    return result;
  }

  SolveResult result;  // of the last descent

 private:
  Vec values(const EnergyTerm& term) const {
    return element_values(term, {}, ColoredBatches(term.element_dofs(), {}), point());
  }

  DegreeSolver& solver_;
  RunRecord& record_;
};

// Puts the stage in place of the bounds.
void DegreeSolver::enter(const BarrierStage& stage) {
  const auto same = [](const BarrierStage::Bound& a, const BarrierStage::Bound& b) {
    return a.checker == b.checker && a.checker;
  };
  const BarrierStage last = std::exchange(bounds_.stage, stage);
  if (!std::equal(last.bounds.begin(), last.bounds.end(), stage.bounds.begin(), stage.bounds.end(),
                  same))
    return rebuild();
  TermChanges changes;
  for (std::size_t k = 0; k < stage.bounds.size(); ++k)
    changes.emplace_back(barriers()[k],
                         TermChange{.weight = weight_beside_map(stage.bounds[k], stage)});
  built_.problem = built_.problem.with(std::move(changes));
  stepper_.reset(built_.problem);
}

SolveResult DegreeSolver::solve_within_bounds(RunRecord& record) {
  SolveResult result = approach(setup_.solve.elevation_tolerance, record);
  if (was_stopped(result.status)) return result;
  const auto violated = [this] { return HeldBounds(bounds_.all).violated(x()); };
  if (!violated()) {
    result = exhaust(kRemedies, remedy_counts_, record);
    if (was_stopped(result.status) || !violated()) return result;
  }
  WithinBounds run(*this, std::move(result), record);
  try {
    const BarrierResult led = BarrierMinimizer::run(run, barrier_options(run.result.energy));
    result = led;
    if (was_stopped(led.status) || led.end == PathEnd::None) return result;
  } catch (const Stopped& stop) {
    return stopped(std::move(run.result), stop.why());
  }
  if (const BarrierChecker* const bound = violated()) {
    if (result.status != Status::Infeasible)
      result.message = fmt::format("no map was found that meets the bound '{}'", bound->name());
    result.status = Status::Infeasible;
    return result;
  }
  remedy_counts_ = {};
  return exhaust(kRemedies, remedy_counts_, record);
}

// The rules of the barriers for an energy like this one.
BarrierOptions DegreeSolver::barrier_options(double energy) const {
  const BoundRules& rules = setup_.rules.bounds;
  BarrierOptions options;
  const double scale =
      std::max(std::abs(energy), rules.least_energy) / std::max(1.0, std::abs(energy));
  options.first_gap = rules.first_share * scale;
  options.tolerance = setup_.solve.tolerance * scale;
  options.fall = rules.weights.fall;
  options.most_phases = rules.weights.most_phases;
  options.entry = rules.entry;
  options.centred = rules.centred;
  options.newton.stopping = unlimited(setup_.solve.tolerance);
  return options;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
