// CHOLMOD [CDHR08], the sparse Cholesky factorization of SuiteSparse, behind LinearSolver: an
// independent factorization to compare the library's own with.
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
  // Automatic chooses like make_direct_solver().
  Ordering ordering = Ordering::Automatic;
  // Automatic is supernodal if the factorization takes at least 40 operations for each entry of the
  // factor (CHOLMOD's own rule).
  enum class Factor { Automatic, Simplicial, Supernodal };
  Factor factor = Factor::Automatic;
};

// Analyses a pattern once and keeps the symbolic factor for all matrices of that pattern. The
// solver computes on one thread: OpenBLAS is set to one thread while any of these solvers computes,
// and gets its former number back afterwards. Throws std::bad_alloc when it runs out of memory, and
// Error(Unsupported) if a factor has more entries than CHOLMOD's 32 bit integers count.
std::unique_ptr<LinearSolver> make_cholmod_solver(CholmodOptions options = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
