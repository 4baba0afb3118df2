// The test whether a factorized matrix is singular to rounding.
#pragma once

#include "majorant/framework/linear_solver.h"
#include "majorant/framework/types.h"

namespace majorant {

// Returns whether a factorized matrix, scaled to diagonal 1, has an eigenvalue below kSingular. It
// is scaled because barriers close to their limits are many times as stiff as the rest. A random
// vector of variance 1 contains about 1 of every eigenvector. H^-1 turns that into 1 / eigenvalue,
// and into sqrt(size) times that if there are many small ones, from which a second step
// distinguishes it.
bool is_singular(LinearSolver& solver, const SparsePattern& pattern, const Vec& values);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
