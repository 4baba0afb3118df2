// The library's direct solver (linear_solver.h), for who wants to know what a factor takes before
// there is one.
//
//   const auto solver = make_direct_solver(Ordering::Automatic, [](std::size_t bytes) {
//     return bytes < 1 << 30 ? nullptr : make_eigen_ldlt_solver();
//   });
#pragma once

#include <cstddef>
#include <functional>

#include "majorant/framework/linear_solver.h"

namespace majorant {

// Asked after every analysis, with the bytes of the factor and of what making it takes besides,
// before they are allocated. What it returns, if anything, has analysed nothing yet and solves
// instead until the next analysis.
using InsteadOfFactor = std::function<std::unique_ptr<LinearSolver>(std::size_t bytes)>;

std::unique_ptr<LinearSolver> make_direct_solver(Ordering ordering, InsteadOfFactor instead);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
