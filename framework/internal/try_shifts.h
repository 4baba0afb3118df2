// The series of shifts of factorize_shifted() (linear_solver.h), for callers that also solve: the
// attempt decides whether a factorization counts.
//
//   const auto attempt = [](double shift) {
//     return shift > 0 ? FactorStatus::Ok : FactorStatus::NotPositiveDefinite;
//   };
//   const ShiftedFactorization done = try_shifts(attempt, 1.0, kSmallestShift, {});
#pragma once

#include <functional>

#include "majorant/framework/linear_solver.h"

namespace majorant {

// diagonal: the matrix's mean_diagonal(), 0 if it has no rows. first: the first shift, relative to
// that.
ShiftedFactorization try_shifts(const std::function<FactorStatus(double shift)>& attempt,
                                double diagonal, double smallest_shift, const StopCheck& stop,
                                double first = 0);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
