#include "majorant/framework/newton.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "majorant/framework/internal/curvature_name.h"
#include "majorant/framework/internal/stopwatch.h"

namespace majorant {
namespace {

// Relative decrement below which rounding errors of the gradient matter. Origin: its square root,
// 1e-5, is the relative distance to the minimum.
constexpr double kPolish = 1e-10;
// Of the mean diagonal. Origin: ten times kPolish, well above the rounding of the Hessian.
constexpr double kPolishShift = 1e-9;
// Part of the decrement below which a decrease says that the Hessian misleads. Origin: a quadratic
// decreases by half of it.
constexpr double kMisleading = 0.1;
// Of the curvature along a rotation that is made up for. Origin: 1 would leave it singular.
constexpr double kRotationShift = 1.5;
// Steps without the exact Hessian after its k-th failure: 2^k, at most 2^kLongestPause. Origin:
// in the long run, trying in vain costs a 32nd of the factorizations.
constexpr int kLongestPause = 5;

}  // namespace

NewtonStepper::NewtonStepper(const Problem& problem, NewtonOptions options)
    : Stepper(problem, options.line_search, options.stopping.decrement, options.stop),
      options_(std::move(options)),
      solver_(options_.linear_solver()) {
  require_curvature(problem);
  solver_->analyze(evaluator_.problem().pattern());
}

void NewtonStepper::require_curvature(const Problem& problem) const {
  for (const TermId k : problem.terms())
    if (!problem.term(k).supports(options_.curvature))
      throw std::invalid_argument(fmt::format("Newton: term '{}' has no curvature model '{}'",
                                              problem.term(k).name(),
                                              curvature_name(options_.curvature)));
}

void NewtonStepper::reset(const Problem& problem) {
  const bool same = problem.same_structure(evaluator_.problem());
  if (!same) require_curvature(problem);
  evaluator_.reset(problem);
  relative_decrement_ = std::numeric_limits<double>::infinity();
  if (!same) solver_->analyze(evaluator_.problem().pattern());
}

void NewtonStepper::advance(Vec& y, double& energy, Step& step) {
  IterationRecord& r = step.record;
  if (!try_exact(y, r) && !factorize(y, r)) return;
  Stopwatch watch;
  Vec p;
  rhs_ = -gradient_;
  solver_->solve(rhs_, p);
  r.seconds.solve = watch.restart();
  const double before = energy;
  move_along(p, 1.0, y, energy, step);
  if (step.outcome == Outcome::Breakdown) return;
  relative_decrement_ = relative_to(before, r.newton_decrement);
  // A decrease far below the model's -g.p / 2: the Hessian is misleading here - unless energies
  // cannot tell.
  if (step.outcome != Outcome::AtMinimum && r.curvature == Curvature::Exact &&
      relative_decrement_ > LineSearch::kResolution &&
      r.relative_decrease < kMisleading * relative_decrement_)
    pause_exact();
}

// Whether the exact Hessian was worth a try and is factorized now. Where the energy is invariant
// under rotations about the origin, the Hessian's curvature along an infinitesimal rotation is
// y.g / |y|^2 (differentiate the gradient along it): a shift by half as much again, when it is
// negative, vanishes at the minimum and makes up for it. Close to the minimum a small one stays, or
// rounding errors of the gradient would turn the map.
bool NewtonStepper::try_exact(const Vec& y, IterationRecord& record) {
  if (options_.curvature == Curvature::Exact || relative_decrement_ > options_.exact_below ||
      !evaluator_.problem().supports(Curvature::Exact))
    return false;
  if (exact_pause_ > 0) {
    --exact_pause_;
    return false;
  }
  Stopwatch watch;
  evaluator_.linearize(y, Curvature::Exact, gradient_, hessian_, stop_);
  record.seconds.assemble += watch.restart();
  const double size = y.squaredNorm();
  record.shift = size > 0 ? kRotationShift * std::max(0.0, -y.dot(gradient_)) / size : 0.0;
  if (relative_decrement_ <= kPolish)
    record.shift = std::max(record.shift,
                            kPolishShift * mean_diagonal(evaluator_.problem().pattern(), hessian_));
  stop_.poll();
  const FactorStatus status = solver_->factorize(hessian_, record.shift);
  record.seconds.factorize += watch.restart();
  record.curvature = Curvature::Exact;
  ++record.factorizations;
  if (status == FactorStatus::Ok) return true;
  ++record.failed_factorizations;
  pause_exact();
  return false;
}

void NewtonStepper::pause_exact() {
  exact_pause_ = 1 << std::min(exact_failures_++, kLongestPause);
}

bool NewtonStepper::factorize(const Vec& y, IterationRecord& record) {
  Stopwatch watch;
  evaluator_.linearize(y, options_.curvature, gradient_, hessian_, stop_);
  record.curvature = options_.curvature;
  record.seconds.assemble += watch.restart();
  if (!gradient_.allFinite()) return false;
  const ShiftedFactorization f =
      factorize_shifted(*solver_, evaluator_.problem().pattern(), hessian_, kSmallestShift, stop_);
  record.shift = f.shift;
  record.factorizations += f.factorizations;
  record.failed_factorizations += f.failed();
  record.seconds.factorize += watch.restart();
  return f.status == FactorStatus::Ok;
}

SolveResult NewtonMinimizer::minimize(const Problem& problem, Vec y0,
                                      const Observer& observer) const {
  NewtonStepper stepper(problem, options_);
  return stepper.minimize(std::move(y0), options_.stopping, observer);
}

}  // namespace majorant
