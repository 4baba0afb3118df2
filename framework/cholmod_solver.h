// CHOLMOD [CDHR08], the sparse Cholesky factorization of SuiteSparse, behind LinearSolver: a second
// factorization to compare the library's own with, and to hold it against.
//
//   NewtonOptions options;
//   options.linear_solver = [] { return make_cholmod_solver(); };
//   NewtonMinimizer newton(options);
//
// Not for speed: make_direct_solver() is faster (docs/linear_solvers.md). Its supernodal part is
// under the GPL, so a build without GPL parts has none of this.
#pragma once

#include <memory>

#include "majorant/framework/linear_solver.h"

namespace majorant {

struct CholmodOptions {
  // Automatic: as make_direct_solver().
  Ordering ordering = Ordering::Automatic;
  // Automatic: supernodal where the factorization takes 40 operations for each entry of the factor,
  // CHOLMOD's own rule.
  enum class Factor { Automatic, Simplicial, Supernodal };
  Factor factor = Factor::Automatic;
};

// Analyses a pattern once and keeps the symbolic factor for all matrices of that pattern. Computes
// on one thread: BLAS, where it is OpenBLAS, has one as long as any of these solvers computes, and
// then as many as before. Throws std::bad_alloc when it runs out of memory, Error(Unsupported)
// where a factor has more entries than CHOLMOD's 32 bit integers count.
std::unique_ptr<LinearSolver> make_cholmod_solver(CholmodOptions options = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
