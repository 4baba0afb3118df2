// The series of shifts of factorize_shifted() (linear_solver.h) for those who also solve: a
// factorization counts only if the attempt says that it does.
//
//   const auto attempt = [](double shift) {
//     return shift > 0 ? FactorStatus::Ok : FactorStatus::NotPositiveDefinite;
//   };
//   SparsePattern pattern;
//   const ShiftedFactorization done = try_shifts(attempt, pattern, Vec(), kSmallestShift, {});
#pragma once

#include <functional>

#include "majorant/framework/linear_solver.h"

namespace majorant {

ShiftedFactorization try_shifts(const std::function<FactorStatus(double shift)>& attempt,
                                const SparsePattern& pattern, const Vec& values,
                                double smallest_shift, const StopCheck& stop);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
