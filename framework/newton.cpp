#include "majorant/framework/newton.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
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

// value / |energy|, 0 / 0 = 0: energies may vanish at their minimum.
double relative_to(double energy, double value) {
  return value / std::max(std::abs(energy), std::numeric_limits<double>::min());
}

}  // namespace

std::string_view name(Status status) {
  switch (status) {
    case Status::Converged:
      return "converged";
    case Status::MaxIterations:
      return "max_iterations";
    case Status::TimeLimit:
      return "time_limit";
    case Status::Interrupted:
      return "interrupted";
    case Status::Stalled:
      return "stalled";
    case Status::Infeasible:
      return "infeasible";
    case Status::Failed:
      return "failed";
  }
  return "failed";
}

// Along x + s d: an acceptable step first (certified, Armijo, halving), then towards the minimum of
// the parabola through E(0), E'(0) and E(s). Positive semidefinite models overestimate curvature
// where they clamp it, and barriers flatten quickly, so steps well above 1 are common far from a
// minimum and in linearly converging tails; an evaluation costs a fraction of a factorization.
class NewtonStepper::LineSearch {
 public:
  LineSearch(Evaluator& evaluator, const NewtonOptions& options, const Vec& y, const Vec& p,
             double energy, double decrement)
      : evaluator_(evaluator),
        options_(options),
        y_(y),
        p_(p),
        energy_(energy),
        decrement_(decrement),
        x_(evaluator.problem().expand(y)) {
    evaluator.problem().elimination().expand_direction(p, d_);
  }

  Outcome find(Step& step) {
    StepBound bound = certified(1.0);
    step.record.step_bound = bound.step;
    step.blocking = std::move(bound.blocking);
    double s = bound.step < 1 ? options_.boundary_fraction * bound.step : 1.0;
    if (s < options_.smallest_step) return Outcome::Blocked;
    while (!accept(s)) {
      s *= 0.5;
      if (s < options_.smallest_step) return Outcome::NoDecrease;
    }
    improve();
    return Outcome::Moved;
  }

  double step() const { return best_step_; }
  double energy() const { return best_energy_; }
  int trials() const { return trials_; }

 private:
  StepBound certified(double s) const {
    StepBound bound{s, {}};
    for (const auto& checker : evaluator_.problem().checkers()) {
      StepBound b = checker->max_step(x_, d_, bound.step);
      if (b.step < bound.step) bound = std::move(b);
    }
    return bound;
  }

  // Whether s passes Armijo and all checkers and beats the best step so far, which it then becomes.
  bool accept(double s) {
    ++trials_;
    const Vec candidate = y_ + s * p_;
    const double trial = evaluator_.value(candidate);
    if (!(trial <= energy_ - options_.armijo * s * decrement_)) return false;
    if (best_step_ > 0 && !(trial < best_energy_)) return false;
    const Vec x = evaluator_.problem().expand(candidate);
    for (const auto& checker : evaluator_.problem().checkers())
      if (!checker->check(x).feasible) return false;
    best_step_ = s;
    best_energy_ = trial;
    return true;
  }

  void improve() {
    for (int round = 0; round < 8; ++round) {
      const double s = best_step_;
      const double curvature = (best_energy_ - energy_ + decrement_ * s) / (s * s);
      const double largest = options_.largest_growth * s;
      double target = curvature > 0 ? std::min(decrement_ / (2 * curvature), largest) : largest;
      if (target > 1.25 * s) {
        const double cap = certified(target).step;
        if (cap < target) target = options_.boundary_fraction * cap;
        if (target <= 1.25 * s) return;
      } else if (target > 0.8 * s) {
        return;
      }
      if (!accept(target)) return;
    }
  }

  Evaluator& evaluator_;
  const NewtonOptions& options_;
  const Vec &y_, &p_;
  double energy_, decrement_;
  Vec x_, d_;
  double best_step_ = 0, best_energy_ = 0;
  int trials_ = 0;
};

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
  if (!try_exact(y, r) && !factorize(y, r)) return step;
  Lap lap;
  Vec p;
  rhs_ = -gradient_;
  solver_->solve(rhs_, p);
  r.seconds.solve = lap();
  r.gradient_norm = gradient_.norm();
  r.newton_decrement = -gradient_.dot(p);
  if (!p.allFinite() || !(r.newton_decrement >= 0)) return step;
  relative_decrement_ = relative_to(energy, r.newton_decrement);
  if (relative_decrement_ <= options_.stopping.decrement) {
    step.outcome = Outcome::AtMinimum;
    return step;
  }
  LineSearch search(evaluator_, options_, y, p, energy, r.newton_decrement);
  step.outcome = search.find(step);
  r.trials = search.trials();
  if (step.outcome == Outcome::Moved) {
    r.step = search.step();
    r.relative_decrease = relative_to(energy, energy - search.energy());
    r.energy = energy = search.energy();
    y += r.step * p;
  }
  // A decrease far below the model's -g.p / 2: the Hessian is misleading here.
  if (r.curvature == Curvature::Exact && r.relative_decrease < 0.1 * relative_decrement_)
    pause_exact();
  r.seconds.line_search = lap();
  return step;
}

// Whether the exact Hessian was worth a try and is factorized now. Where the energy is invariant
// under rotations about the origin, the Hessian's curvature along an infinitesimal rotation is
// y.g / |y|^2 (differentiate the gradient along it): a shift by that much, when it is negative,
// vanishes at the minimum and makes up for it.
bool NewtonStepper::try_exact(const Vec& y, IterationRecord& record) {
  if (options_.curvature == Curvature::Exact || relative_decrement_ > options_.exact_below ||
      !evaluator_.problem().supports(Curvature::Exact))
    return false;
  if (exact_pause_ > 0) {
    --exact_pause_;
    return false;
  }
  Lap lap;
  evaluator_.linearize(y, Curvature::Exact, gradient_, hessian_);
  record.seconds.assemble += lap();
  const double size = y.squaredNorm();
  record.shift = size > 0 ? 1.5 * std::max(0.0, -y.dot(gradient_)) / size : 0.0;
  const FactorStatus status = solver_->factorize(hessian_, record.shift);
  record.seconds.factorize += lap();
  record.curvature = Curvature::Exact;
  if (status == FactorStatus::Ok) return true;
  pause_exact();
  return false;
}

void NewtonStepper::retry_exact() { exact_pause_ = 0; }

void NewtonStepper::pause_exact() { exact_pause_ = 1 << std::min(exact_failures_++, 5); }

// Assembles the chosen curvature; when it is not positive definite numerically, a growing multiple
// of its mean diagonal is added.
bool NewtonStepper::factorize(const Vec& y, IterationRecord& record) {
  Lap lap;
  evaluator_.linearize(y, options_.curvature, gradient_, hessian_);
  record.curvature = options_.curvature;
  record.seconds.assemble += lap();
  const SparsePattern& pattern = evaluator_.problem().pattern();
  double diagonal = 0;
  for (Index c = 0; c < pattern.size; ++c)
    diagonal += std::abs(hessian_[pattern.column_starts[static_cast<std::size_t>(c)]]);
  diagonal /= pattern.size;
  if (!std::isfinite(diagonal) || !gradient_.allFinite()) return false;
  FactorStatus status = FactorStatus::NotPositiveDefinite;
  double shift = 0;
  for (int attempt = 0; attempt < 24; ++attempt) {
    status = solver_->factorize(hessian_, shift);
    if (status != FactorStatus::NotPositiveDefinite) break;
    shift = shift == 0 ? 1e-14 * diagonal : 10 * shift;
  }
  record.shift = shift;
  record.seconds.factorize += lap();
  return status == FactorStatus::Ok;
}

SolveResult run(NewtonStepper& stepper, Vec y0, const StoppingRules& rules,
                const Observer& observer) {
  SolveResult result;
  result.y = std::move(y0);
  const auto finish = [&](Status status, std::string message) {
    result.status = status;
    result.message = std::move(message);
    return result;
  };
  const Problem& problem = stepper.evaluator().problem();
  const Vec x = problem.expand(result.y);
  for (const auto& checker : problem.checkers())
    if (Verdict verdict = checker->check(x); !verdict.feasible) {
      result.blocking = std::move(verdict.blocking);
      return finish(Status::Infeasible,
                    std::string("the start violates ") + std::string(checker->name()));
    }
  result.energy = stepper.evaluator().value(result.y);
  if (!std::isfinite(result.energy))
    return finish(Status::Infeasible, "the start lies outside the energy's domain");

  // An energy that vanishes at its minimum has no relative scale there.
  const double smallest_scale = 1e-14 * std::abs(result.energy);
  int idle = 0;
  bool polished = false;
  Vec anchor = result.y;  // last point from which a good part of the step was possible
  double anchor_energy = result.energy;
  for (int k = 1; k <= rules.max_iterations; ++k) {
    const double scale = std::max(std::abs(result.energy), smallest_scale);
    NewtonStepper::Step step = stepper.step(result.y, result.energy);
    step.record.iteration = k;
    result.newton_decrement = step.record.newton_decrement;
    result.blocking = std::move(step.blocking);
    using Outcome = NewtonStepper::Outcome;
    const bool near = result.newton_decrement <= rules.stall_decrement * scale;
    if (step.outcome == Outcome::Breakdown)
      return finish(Status::Failed, "no finite Newton direction");
    if (step.outcome == Outcome::AtMinimum) return finish(Status::Converged, "Newton decrement");
    if (step.outcome != Outcome::Moved)
      return finish(near ? Status::Converged : Status::Stalled, "no further decrease");
    result.iterations.push_back(step.record);
    const Directive directive = observer ? observer(step.record, result.y) : Directive::Continue;
    const bool small_decrease = step.record.relative_decrease <= rules.relative_decrease;
    const bool exact = step.record.curvature == Curvature::Exact;
    if (small_decrease && !exact &&
        result.newton_decrement <= rules.tail_factor * rules.relative_decrease * scale) {
      if (polished) return finish(Status::Converged, "relative decrease");
      stepper.retry_exact();
      polished = true;
    }
    idle = small_decrease || step.record.step_bound < rules.stall_step ? idle + 1 : 0;
    if (idle >= rules.stall_iterations) {
      if (near) return finish(Status::Converged, "relative decrease");
      result.y = anchor;
      result.energy = anchor_energy;
      return finish(Status::Stalled, "held at the limit of the feasible set");
    }
    if (idle == 0 && step.record.step_bound >= rules.anchor_step) {
      anchor = result.y;
      anchor_energy = result.energy;
    }
    if (directive == Directive::TimeLimit) return finish(Status::TimeLimit, "time limit");
    if (directive == Directive::Interrupt) return finish(Status::Interrupted, "interrupted");
  }
  return finish(Status::MaxIterations, "iteration limit");
}

SolveResult NewtonMinimizer::minimize(const Problem& problem, Vec y0,
                                      const Observer& observer) const {
  NewtonStepper stepper(problem, options_);
  return run(stepper, std::move(y0), options_.stopping, observer);
}

}  // namespace majorant
