// Estimates the memory that linear solvers would take, from which a run chooses a solver.
//
//   const SolverMemory memory = solver_memory(FactorSize{5000, 200}, available_memory());
//   const bool multigrid = memory.prefers_multigrid();
#pragma once

#include <cstddef>
#include <optional>

#include "majorant/io/files/available_memory.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// The memory of a direct solver for the matrices of a pattern.
struct FactorSize {
  std::size_t bytes = 0;    // the factor and its making (LinearSolver::bytes())
  std::size_t entries = 0;  // entries of the pattern
};

// Returns an upper bound for maps of degree `degree` on these faces, from their number, for
// surfaces of few handles. degree >= 2.
FactorSize factor_size_at_most(const SurfaceMesh& mesh, int degree);
// Returns an estimate for an unconstrained map. Costs an analysis.
FactorSize factor_size(const SurfaceMesh& mesh, int degree);

// The memory that the solvers of one process need and that is available, in bytes.
struct SolverMemory {
  std::size_t direct = 0, multigrid = 0;  // with everything besides the matrix
  std::optional<std::size_t> available;   // none: unknown, everything fits

  bool fits_direct() const { return !available || direct <= *available; }
  // Direct is the fastest solver that fits. If neither fits, the smaller one is preferred.
  bool prefers_multigrid() const { return !fits_direct() && multigrid < direct; }
};

// The environment variable MAJORANT_MULTIGRID_BYTES replaces the estimate for multigrid, for tests.
SolverMemory solver_memory(const FactorSize& needed, std::optional<std::size_t> available);
// Returns the same for a future problem, which will itself have taken a part of the available
// memory.
SolverMemory foreseen_memory(const FactorSize& needed, std::optional<std::size_t> available);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
