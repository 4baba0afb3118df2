#include "majorant/framework/linear_solver.h"

#include <cmath>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/internal/try_shifts.h"

namespace majorant {
namespace {

// The growth of a shift that was too small; linear_solver.h documents the series.
constexpr double kShiftGrowth = 10;
// The maximum number of factorizations, the first without a shift: shifts go from 1e-14 to 1e8
// times the mean diagonal, where the shift dominates.
constexpr int kMostShifts = 24;

}  // namespace

FactorStatus LinearSolver::factorize_until(const StopCheck&, const Vec& values, double shift) {
  return factorize(values, shift);
}

double mean_diagonal(const SparsePattern& pattern, const Vec& values) {
  double sum = 0;
  for (Index c = 0; c < pattern.size; ++c) sum += std::abs(values[pattern.column_starts[c]]);
  return sum / pattern.size;
}

ShiftedFactorization factorize_shifted(LinearSolver& solver, const SparsePattern& pattern,
                                       const Vec& values, double smallest_shift,
                                       const StopCheck& stop) {
  require_size("factorize_shifted: values", values.size(), pattern.nonzeros());
  const auto attempt = [&](double shift) { return solver.factorize_until(stop, values, shift); };
  return try_shifts(attempt, pattern.size > 0 ? mean_diagonal(pattern, values) : 0, smallest_shift,
                    stop);
}

ShiftedFactorization try_shifts(const std::function<FactorStatus(double shift)>& attempt,
                                double diagonal, double smallest_shift, const StopCheck& stop,
                                double first) {
  ShiftedFactorization result;
  if (!std::isfinite(diagonal)) return result;
  double shift = first * diagonal;
  for (int k = 0; k < kMostShifts; ++k) {
    stop.poll();
    ++result.factorizations;
    result.status = attempt(shift);
    result.shift = shift;
    if (result.status != FactorStatus::NotPositiveDefinite) break;
    shift = shift == 0 ? smallest_shift * diagonal : kShiftGrowth * shift;
  }
  return result;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
