// What solvers would take of the memory that is left.
//
//   const SolverMemory memory = solver_memory(FactorSize{5000, 200}, available_memory());
//   const bool multigrid = memory.prefers_multigrid();
#pragma once

#include <cstddef>
#include <optional>

#include "majorant/framework/internal/available_memory.h"
#include "majorant/framework/linear_solver.h"

namespace majorant {

// What the solvers of one process take, and what there is: bytes.
struct SolverMemory {
  std::size_t direct = 0, multigrid = 0;  // with all that they need besides the matrix
  std::optional<std::size_t> available;   // none: nobody says, and all fits

  bool fits_direct() const { return !available || direct <= *available; }
  // Direct is the fastest that fits. Of two that do not fit, what takes less.
  bool prefers_multigrid() const { return !fits_direct() && multigrid < direct; }
};

// The environment's MAJORANT_MULTIGRID_BYTES, for tests, replaces the estimate for multigrid.
SolverMemory solver_memory(const FactorSize& needed, std::optional<std::size_t> available);
// Of a problem that is not made yet, and will have taken a part of what is available by then.
SolverMemory foreseen_memory(const FactorSize& needed, std::optional<std::size_t> available);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
