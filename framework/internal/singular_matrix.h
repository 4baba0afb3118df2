// The test whether a factorized matrix is singular to rounding.
#pragma once

#include "majorant/framework/linear_solver.h"
#include "majorant/framework/types.h"

namespace majorant {

// Returns whether a factorized matrix has an eigenvalue below kSingular where its diagonal is
// scaled to 1: barriers beside their limits are many times as stiff as the rest. A vector of random
// numbers of variance 1 has about 1 of every eigenvector, so that H^-1 makes 1 / eigenvalue of it,
// and up to sqrt(size) of that where there are many small ones; a second step tells these apart.
bool is_singular(LinearSolver& solver, const SparsePattern& pattern, const Vec& values);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
