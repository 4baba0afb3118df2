// Linear solvers of PETSc behind LinearSolver: of one process or of several.
//
//     auto record = std::make_shared<LadderRecord>();
//     newton.linear_solver = petsc_solver({.first = Rung::Amg}, record);
//
// A solve begins on the first rung that is asked for and goes down the ladder when that fails:
// conjugate gradients with BoomerAMG (u and v of a node are kept apart on all its levels, where all
// nodes have both), then with incomplete Cholesky factors of each rank's block, then MUMPS, which
// factorizes. Multigrid breaks down where triangles are nearly collapsed (a Tutte start); a
// factorization does not. After a fall a number of matrices start on the rung that held.
//
// A matrix is indefinite where two conjugate gradients meet negative curvature on different
// preconditioners, where MUMPS counts a negative pivot, and where -g.p says so whatever the solver
// thinks.
//
// Conjugate gradients give the same bits in every run of as many ranks; MUMPS on several adds what
// they send in the order in which it comes.
#pragma once

#include <memory>

#include "majorant/apps/jobs/solver_ladder.h"

namespace majorant {

// Throws Error(Unsupported), when it analyses, for more unknowns than PETSc's integers count.
SolverFactory petsc_solver(const LadderOptions& options, std::shared_ptr<LadderRecord> record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
