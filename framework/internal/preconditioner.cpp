#include "majorant/framework/internal/preconditioner.h"

#include <algorithm>
#include <utility>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"
#include "majorant/framework/internal/try_shifts.h"
#include "majorant/framework/partition.h"
#include "majorant/framework/problem_parts.h"
#include "majorant/framework/stepper.h"
#include "majorant/framework/stopwatch.h"

namespace majorant {
namespace {

// The first shift, relative to the mean diagonal. kSmallestShift would be too small for a metric
// that stays: every step would go down its near null space.
constexpr double kMetricShift = 1e-3;

bool same_z(const Elimination& a, const Elimination& b) {
  if (a.full_size() != b.full_size() || a.reduced_size() != b.reduced_size()) return false;
  return a.begins_like(b, a.full_size());
}

}  // namespace

Preconditioner::Preconditioner(const Problem& problem, Curvature curvature,
                               std::shared_ptr<LinearSolver> solver)
    : evaluator_(problem), curvature_(curvature), solver_(std::move(solver)) {
  require_given("the metric's linear solver", solver_);
  require_curvature("the metric", problem, curvature);
  const Problem& kept = evaluator_.problem();  // outlives the solver
  analyze_shared(*solver_, kept.pattern(), partition_of(kept));
}

bool Preconditioner::factorize(VecIn y, const StopCheck& stop) {
  Stopwatch watch;
  evaluator_.linearize(y, curvature_, gradient_, hessian_, stop);
  assemble_seconds_ = watch.restart();
  const Problem& problem = evaluator_.problem();
  const double diagonal = partition_of(problem).global_size() > 0
                              ? mean_diagonal(problem.pattern(), hessian_, partition_of(problem))
                              : 0;
  const ShiftedFactorization f =
      try_shifts([&](double shift) { return solver_->factorize_until(stop, hessian_, shift); },
                 diagonal, kMetricShift, stop);
  shift_ = f.shift;
  factorizations_ = f.factorizations;
  failed_factorizations_ = f.failed();
  factorize_seconds_ = watch.restart();
  return f.status == FactorStatus::Ok;
}

bool Preconditioner::factorize_once(VecIn y, IterationRecord& record, const StopCheck& stop) {
  if (!factorized_) {
    factorized_ = factorize(y, stop);
    record.seconds.assemble = assemble_seconds_;
    record.seconds.factorize = factorize_seconds_;
    record.factorizations = factorizations_;
    record.failed_factorizations = failed_factorizations_;
  }
  record.curvature = curvature_;
  record.shift = shift_;
  return factorized_;
}

std::string Preconditioner::why_none() const {
  if (partition_of(evaluator_.problem()).all(hessian_.isZero(0)))
    return "no direction: the metric has no curvature here, its Hessian is 0";
  return "no direction: no shift makes the metric's Hessian positive definite";
}

const Problem& preconditioner_problem(const Problem& problem,
                                      const std::optional<Problem>& metric) {
  if (!metric) return problem;
  if (!same_z(ProblemParts::elimination(problem), ProblemParts::elimination(*metric)))
    throw InvalidArgument("the metric's problem has other unknowns or constraints");
  return *metric;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
