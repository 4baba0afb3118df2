// The library's direct solver (linear_solver.h), for who wants to know what a factor takes before
// there is one.
//
//   const auto solver = make_direct_solver(Ordering::Automatic, [](const FactorSize& needed) {
//     return needed.bytes < 1 << 30 ? nullptr : make_eigen_ldlt_solver();
//   });
#pragma once

#include <functional>

#include "majorant/framework/linear_solver.h"

namespace majorant {

// Asked after every analysis, before what is needed is allocated. What it returns, if anything, has
// analysed nothing yet and solves instead until the next analysis.
using InsteadOfFactor = std::function<std::unique_ptr<LinearSolver>(const FactorSize& needed)>;

std::unique_ptr<LinearSolver> make_direct_solver(Ordering ordering, InsteadOfFactor instead);

// What such a solver would ask with: costs the analysis, and allocates no factor.
FactorSize factor_size(const SparsePattern& pattern, Ordering ordering);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
