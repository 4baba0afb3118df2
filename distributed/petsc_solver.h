// Linear solvers of PETSc behind LinearSolver: of one process or of several.
//
//     auto record = std::make_shared<LadderRecord>();
//     newton.linear_solver = petsc_solver({.first = Rung::Amg}, record);
//
// A solve begins on the first rung that is asked for and goes down the ladder when that fails:
// conjugate gradients with BoomerAMG (each unknown a scalar: its variant for vectors is worse
// here), then with incomplete Cholesky factors of each rank's block, then MUMPS, which factorizes.
// Multigrid breaks down where triangles are nearly collapsed (a Tutte start); a factorization does
// not. After a fall a number of matrices start on the rung that held.
//
// A matrix is indefinite where two conjugate gradients meet negative curvature on different
// preconditioners, where MUMPS counts a negative pivot, and where -g.p says so whatever the solver
// thinks.
//
// Conjugate gradients give the same bits in every run of as many ranks; MUMPS on several adds what
// they send in the order in which it comes.
#pragma once

#include <array>
#include <memory>
#include <string_view>

#include "majorant/framework/linear_solver.h"

namespace majorant {

enum class Rung { Amg, Gamg, Icc, Mumps };
inline constexpr std::array<std::string_view, 4> kRungNames{"cg-hypre", "cg-gamg", "cg-icc",
                                                            "mumps"};

// What the solvers of a run did, rung by rung.
struct LadderRecord {
  struct Use {
    long set_ups = 0, solves = 0, iterations = 0, falls = 0;  // falls: what failed there
    int most_iterations = 0;                                  // of one solve
  };
  std::array<Use, kRungNames.size()> rungs{};
  long indefinite = 0;  // matrices
};

struct LadderOptions {
  // The first rung; Gamg is not on the way down of the others.
  Rung first = Rung::Amg;
  // Systems of fewer unknowns begin with MUMPS, 0: none does.
  GlobalIndex direct_below = 0;
};

// Throws Error(Unsupported), when it analyses, for more unknowns than PETSc's integers count.
SolverFactory petsc_solver(const LadderOptions& options, std::shared_ptr<LadderRecord> record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
