// Linear solvers of PETSc as LinearSolver, for one process or several.
//
//     auto record = std::make_shared<FallbackRecord>();
//     newton.linear_solver = petsc_solver({.first = PetscMethod::Amg}, record);
//
// The methods form a fallback chain: a solve begins with the requested one, and the next one takes
// over if it fails. They are conjugate gradients with BoomerAMG, conjugate gradients with
// incomplete Cholesky factors of each rank's block, and MUMPS, which factorizes. BoomerAMG keeps u
// and v apart on all levels, if all nodes have both. Multigrid breaks down if triangles are nearly
// collapsed, as in some Tutte starts; a factorization does not. After a failure, some matrices
// start with the method that solved.
//
// A matrix counts as indefinite in three cases: two conjugate gradient solves meet negative
// curvature with different preconditioners, MUMPS counts a negative pivot, or -g.p is not positive.
//
// Conjugate gradients give the same bits in every run on the same number of ranks. MUMPS on several
// ranks adds messages in the order of their arrival.
#pragma once

#include <memory>

#include "majorant/apps/jobs/petsc_fallback.h"

namespace majorant {

// Throws Error(Unsupported) during the analysis if there are more unknowns than PETSc's integers
// can count.
SolverFactory petsc_solver(const FallbackOptions& options, std::shared_ptr<FallbackRecord> record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
