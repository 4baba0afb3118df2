// The series of shifts of factorize_shifted() (linear_solver.h) for those who also solve: a
// factorization counts only if the attempt says that it does.
//
//   const auto attempt = [](double shift) {
//     return shift > 0 ? FactorStatus::Ok : FactorStatus::NotPositiveDefinite;
//   };
//   const ShiftedFactorization done = try_shifts(attempt, 1.0, kSmallestShift, {});
#pragma once

#include <functional>

#include "majorant/framework/linear_solver.h"

namespace majorant {

// diagonal: the matrix's mean_diagonal(), 0 where it has no rows. first: the shift, relative to it,
// that the series begins with.
ShiftedFactorization try_shifts(const std::function<FactorStatus(double shift)>& attempt,
                                double diagonal, double smallest_shift, const StopCheck& stop,
                                double first = 0);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
