#include "majorant/parametrization/drive/degree_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "majorant/parametrization/drive/solver_rules.h"

namespace majorant {
namespace {

constexpr double kExcludedWeight = 1e-6;  // method.md section 9
constexpr int kExcludedIterations = 10;
constexpr int kStallRounds = 60;
constexpr double kIsometry = 4;  // symmetric Dirichlet density
constexpr double kBarrierTolerance = 1e-4;

}  // namespace

DegreeSolver::DegreeSolver(const Setup& setup, std::shared_ptr<const BezierTriangleSpace> space,
                           Vec x)
    : setup_(setup),
      space_(std::move(space)),
      x_(std::move(x)),
      start_(x_),
      levels_(optimizer_ladder(space_->degree(), setup.options.quadrature_points),
              space_->element_count()),
      terms_(energy_terms(setup.map, space_, levels_.rules())),
      depth_(setup.options.injectivity_depth),
      injectivity_(std::make_shared<const LocalInjectivity>(space_, 2 * setup.map.rest.measure,
                                                            depth_, setup.stop)),
      element_weight_(Vec::Ones(space_->element_count())),
      problem_(build_problem()),
      stepper_(problem_, newton_options(setup.options.curvature, setup.stop)) {}

Problem DegreeSolver::build_problem() const {
  require_curvature(terms_, setup_.options.curvature);
  setup_.stop.poll();
  Problem problem = map_problem(setup_.map, space_, start_, terms_, injectivity_);
  setup_.stop.poll();  // what follows is the analysis of its pattern
  return problem;
}

double DegreeSolver::constraint_residual() const {
  double residual = 0;
  problem_.reduce(x_, &residual);
  return residual;
}

SolveResult DegreeSolver::run_once(const StoppingRules& rules, RunRecord& record) {
  StoppingRules limited = rules;
  limited.max_iterations = std::min(rules.max_iterations, record.iterations_left());
  SolveResult result =
      stepper_.minimize(problem_.reduce(x_), limited, record.observer(space_->degree()));
  x_ = problem_.expand(result.y);
  return result;
}

void DegreeSolver::soften_start(RunRecord& record) {
  const Observer observe = record.observer(space_->degree());
  const Vec& measure = setup_.map.rest.measure;
  Vec y = problem_.reduce(x_);
  bool go_on = record.directive() == Directive::Continue;
  while (go_on && record.iterations_left() > 0) {
    const Vec weight = soft_weights(
        energy_by_face(setup_.map, terms_, levels_.of_faces(), problem_.expand(y)), measure);
    if (weight.size() == 0) break;
    stepper_.reset(problem_.with(energy_states(setup_.map, problem_, levels_.of_faces(), weight)));
    double energy = stepper_.evaluator().value(y);
    const NewtonStepper::Step step = stepper_.step(y, energy);
    if (step.outcome != NewtonStepper::Outcome::Moved) break;
    go_on = observe(step.record, y) == Directive::Continue;
  }
  x_ = problem_.expand(y);
  stepper_.reset(problem_);
}

SolveResult DegreeSolver::approach(double tolerance, RunRecord& record) {
  StoppingRules rules;
  rules.relative_decrease = tolerance;
  rules.stall_decrement = std::numeric_limits<double>::infinity();
  rules.max_iterations = std::numeric_limits<int>::max();
  return run_once(rules, record);
}

SolveResult DegreeSolver::finish(RunRecord& record) {
  const SolveResult result = exhaust(record);
  const bool barrier = std::any_of(terms_.begin(), terms_.end(), [](const auto& term) {
    return term->name() == "symmetric-dirichlet";
  });
  return result.status == Status::Stalled && !barrier ? follow_barrier(result, record) : result;
}

SolveResult DegreeSolver::exhaust(RunRecord& record) {
  StoppingRules rules;
  rules.relative_decrease = setup_.options.tolerance;
  rules.max_iterations = std::numeric_limits<int>::max();
  SolveResult result = run_once(rules, record);
  try {
    help(result, rules, record);
  } catch (const Stopped& stop) {
    return stopped(result, stop.why());
  }
  return result;
}

// Runs again as long as a stall can be left or the quadrature be refined.
void DegreeSolver::help(SolveResult& result, const StoppingRules& rules, RunRecord& record) {
  for (int stalls = 0, refinements = 0;; result = run_once(rules, record)) {
    if (result.status == Status::Stalled && stalls++ < kStallRounds) {
      const double before = result.energy;
      const bool changed = deepen() || climb(result.blocking);
      if (!changed) result = leave_stall(result, record);
      if (!changed && (!(result.energy < before) || was_stopped(result.status))) return;
    } else if (result.status != Status::Converged || refinements++ >= kAccuracyRounds ||
               !climb_inaccurate()) {
      return;
    }
  }
}

// The certificate may be too coarse rather than the map too close to degenerate: bisect deeper.
bool DegreeSolver::deepen() {
  if (depth_ >= kDeepestBisection) return false;
  depth_ = std::min(depth_ + kBisectionsDeeper, kDeepestBisection);
  depth_counts_ = injectivity_depth_counts();
  injectivity_ = std::make_shared<const LocalInjectivity>(space_, 2 * setup_.map.rest.measure,
                                                          depth_, setup_.stop);
  problem_ = build_problem();
  apply_state();
  return true;
}

std::vector<long> DegreeSolver::injectivity_depth_counts() const {
  return add_counts(injectivity_->depth_counts(), depth_counts_);
}

void DegreeSolver::apply_state() {
  problem_ =
      problem_.with(energy_states(setup_.map, problem_, levels_.of_faces(), element_weight_));
  stepper_.reset(problem_);
}

bool DegreeSolver::climb(const std::vector<Index>& elements) {
  const bool climbed = levels_.climb(elements);
  if (climbed) apply_state();
  return climbed;
}

// Raises the elements whose integrals are worst until the rest is within the bound.
bool DegreeSolver::climb_inaccurate() {
  if (setup_.options.quadrature_points > 0) return false;
  const bool climbed = levels_.climb_inaccurate(setup_.map, terms_, x_, setup_.stop);
  if (climbed) apply_state();
  return climbed;
}

// [MC20] Sec. 4.3: the blocking triangles lose their say for a few steps, not their positivity.
SolveResult DegreeSolver::leave_stall(const SolveResult& stalled, RunRecord& record) {
  if (stalled.blocking.empty()) return stalled;
  const Vec best = x_;
  for (const Index e : stalled.blocking) element_weight_[e] = kExcludedWeight;
  apply_state();
  StoppingRules rules;
  rules.relative_decrease = 1e-3;
  rules.max_iterations = kExcludedIterations;
  run_once(rules, record);
  element_weight_.setOnes();
  apply_state();
  rules.max_iterations = std::numeric_limits<int>::max();
  const SolveResult result = run_once(rules, record);
  return result.energy < stalled.energy ? result : back_to(best, stalled, result.status);
}

// A way out that led nowhere, or was stopped before it led anywhere.
SolveResult DegreeSolver::back_to(const Vec& best, SolveResult stalled, Status way_out) {
  x_ = best;
  if (!was_stopped(way_out)) return stalled;
  return stopped(std::move(stalled),
                 way_out == Status::TimeLimit ? Directive::TimeLimit : Directive::Interrupt);
}

// Interior points: the energy plus mu times symmetric Dirichlet, whose barrier is strong, for
// falling mu leads around corners that an energy with a weak barrier, or none, ran into.
SolveResult DegreeSolver::follow_barrier(const SolveResult& stalled, RunRecord& record) {
  const Vec best = x_;
  const double scale = std::abs(stalled.energy) / kIsometry;
  for (const double mu : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6})
    if (!step_aside(mu * scale, record)) break;
  const SolveResult result = exhaust(record);
  // On the same rules, which may have become finer on the way.
  const auto energy_at = [&](const Vec& x) {
    return stepper_.evaluator().value(problem_.reduce(x));
  };
  return energy_at(x_) < energy_at(best) ? result : back_to(best, stalled, result.status);
}

// Minimizes with that much of the symmetric Dirichlet energy; whether to go on.
bool DegreeSolver::step_aside(double weight, RunRecord& record) {
  Setup with = setup_;
  with.map.energy.push_back({symmetric_dirichlet(), weight});
  with.options.curvature = Curvature::Projected;
  try {
    DegreeSolver inner(with, space_, x_);
    const SolveResult result = inner.approach(kBarrierTolerance, record);
    x_ = inner.x();
    depth_counts_ = add_counts(std::move(depth_counts_), inner.injectivity_depth_counts());
    return result.status == Status::Converged || result.status == Status::Stalled;
  } catch (const Stopped&) {  // before it began
    return false;
  }
}

}  // namespace majorant
