// A linear solver that counts and times the calls of a method.
#pragma once

#include <memory>

#include "majorant/framework/linear_solver.h"

namespace majorant {

struct SolverUse {
  int factorizations = 0;                           // failed ones included
  double factorize_seconds = 0, solve_seconds = 0;  // analyses count as factorization
};

// use: the sum over all solvers that the factory makes.
SolverFactory watched_solver(SolverFactory factory, std::shared_ptr<SolverUse> use);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
