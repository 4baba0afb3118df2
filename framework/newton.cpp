#include "majorant/framework/newton.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace majorant {
namespace {

using Clock = std::chrono::steady_clock;

// Seconds since the last call.
class Lap {
 public:
  double operator()() {
    const auto now = Clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }

 private:
  Clock::time_point last_ = Clock::now();
};

}  // namespace

std::string_view name(Status status) {
  switch (status) {
    case Status::Converged: return "converged";
    case Status::MaxIterations: return "max_iterations";
    case Status::TimeLimit: return "time_limit";
    case Status::Interrupted: return "interrupted";
    case Status::Stalled: return "stalled";
    case Status::Infeasible: return "infeasible";
    case Status::Failed: return "failed";
  }
  return "failed";
}

NewtonStepper::NewtonStepper(const Problem& problem, NewtonOptions options)
    : options_(std::move(options)), evaluator_(problem), solver_(options_.linear_solver()) {
  solver_->analyze(evaluator_.problem().pattern());
}

void NewtonStepper::reset(const Problem& problem) {
  const bool same = problem.same_structure(evaluator_.problem());
  evaluator_.reset(problem);
  if (!same) solver_->analyze(evaluator_.problem().pattern());
}

NewtonStepper::Step NewtonStepper::step(Vec& y, double& energy) {
  Step step;
  IterationRecord& r = step.record;
  r.energy = energy;
  if (y.size() == 0) {
    step.outcome = Outcome::AtMinimum;
    return step;
  }
  Lap lap;
  evaluator_.linearize(y, options_.curvature, gradient_, hessian_);
  r.gradient_norm = gradient_.norm();
  r.seconds.assemble = lap();
  Vec p;
  if (!std::isfinite(r.gradient_norm) || !find_direction(r, p)) return step;
  r.newton_decrement = -gradient_.dot(p);
  if (r.newton_decrement <= options_.stopping.decrement * std::abs(energy)) {
    step.outcome = Outcome::AtMinimum;
    return step;
  }
  lap();
  step.outcome = line_search(y, energy, p, step);
  r.seconds.line_search = lap();
  return step;
}

// H p = -g; when H is not positive definite, a growing multiple of its mean diagonal is added.
bool NewtonStepper::find_direction(IterationRecord& record, Vec& p) {
  Lap lap;
  const SparsePattern& pattern = evaluator_.problem().pattern();
  double diagonal = 0;
  for (Index c = 0; c < pattern.size; ++c)
    diagonal += std::abs(hessian_[pattern.column_starts[static_cast<std::size_t>(c)]]);
  diagonal /= pattern.size;
  if (!std::isfinite(diagonal)) return false;
  FactorStatus status = FactorStatus::NotPositiveDefinite;
  double shift = 0;
  for (int attempt = 0; attempt < 16; ++attempt) {
    status = solver_->factorize(hessian_, shift);
    if (status != FactorStatus::NotPositiveDefinite) break;
    shift = shift == 0 ? 1e-14 * diagonal : 10 * shift;
  }
  record.shift = shift;
  record.seconds.factorize = lap();
  if (status != FactorStatus::Ok) return false;
  rhs_ = -gradient_;
  solver_->solve(rhs_, p);
  record.seconds.solve = lap();
  return p.allFinite() && gradient_.dot(p) <= 0;
}

StepBound NewtonStepper::certified_step(const Vec& x, const Vec& d) const {
  StepBound bound{1.0, {}};
  for (const auto& checker : evaluator_.problem().checkers()) {
    StepBound b = checker->max_step(x, d, bound.step);
    if (b.step < bound.step) bound = std::move(b);
  }
  return bound;
}

bool NewtonStepper::feasible(const Vec& x) const {
  for (const auto& checker : evaluator_.problem().checkers())
    if (!checker->check(x).feasible) return false;
  return true;
}

NewtonStepper::Outcome NewtonStepper::line_search(Vec& y, double& energy, const Vec& p,
                                                  Step& step) {
  IterationRecord& r = step.record;
  const Problem& problem = evaluator_.problem();
  const Vec x = problem.expand(y);
  Vec d;
  problem.elimination().expand_direction(p, d);
  StepBound bound = certified_step(x, d);
  r.step_bound = bound.step;
  step.blocking = std::move(bound.blocking);
  double s = bound.step < 1 ? options_.boundary_fraction * bound.step : 1.0;
  if (s < options_.smallest_step) return Outcome::Blocked;
  for (; s >= options_.smallest_step; s *= 0.5) {
    const Vec candidate = y + s * p;
    const double trial = evaluator_.value(candidate);
    ++r.trials;
    if (!(trial <= energy - options_.armijo * s * r.newton_decrement)) continue;
    if (!feasible(problem.expand(candidate))) continue;
    r.step = s;
    r.relative_decrease = (energy - trial) / std::abs(energy);
    r.energy = energy = trial;
    y = candidate;
    return Outcome::Moved;
  }
  return Outcome::NoDecrease;
}

SolveResult NewtonMinimizer::minimize(const Problem& problem, Vec y0,
                                      const Observer& observer) const {
  SolveResult result;
  result.y = std::move(y0);
  const auto finish = [&](Status status, std::string message) {
    result.status = status;
    result.message = std::move(message);
    return result;
  };
  const Vec x = problem.expand(result.y);
  for (const auto& checker : problem.checkers())
    if (!checker->check(x).feasible)
      return finish(Status::Infeasible, std::string("the start violates ") +
                                            std::string(checker->name()));
  NewtonStepper stepper(problem, options_);
  result.energy = stepper.evaluator().value(result.y);
  if (!std::isfinite(result.energy))
    return finish(Status::Infeasible, "the start lies outside the energy's domain");

  const StoppingRules& rules = options_.stopping;
  for (int k = 1; k <= rules.max_iterations; ++k) {
    NewtonStepper::Step step = stepper.step(result.y, result.energy);
    step.record.iteration = k;
    result.newton_decrement = step.record.newton_decrement;
    result.blocking = std::move(step.blocking);
    using Outcome = NewtonStepper::Outcome;
    const double scale = std::abs(result.energy);
    const bool near = result.newton_decrement <= rules.stall_decrement * scale;
    if (step.outcome == Outcome::Breakdown)
      return finish(Status::Failed, "no finite Newton direction");
    if (step.outcome == Outcome::AtMinimum) return finish(Status::Converged, "Newton decrement");
    if (step.outcome != Outcome::Moved)
      return finish(near ? Status::Converged : Status::Stalled, "no further decrease");
    result.iterations.push_back(step.record);
    const Directive directive = observer ? observer(step.record, result.y) : Directive::Continue;
    if (step.record.relative_decrease <= rules.relative_decrease)
      return finish(near ? Status::Converged : Status::Stalled, "relative decrease");
    if (directive == Directive::TimeLimit) return finish(Status::TimeLimit, "time limit");
    if (directive == Directive::Interrupt) return finish(Status::Interrupted, "interrupted");
  }
  return finish(Status::MaxIterations, "iteration limit");
}

}  // namespace majorant
