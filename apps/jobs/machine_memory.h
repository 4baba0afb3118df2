// The part of the memory that is left that linear solvers would take: by which a run chooses one.
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
  std::size_t bytes = 0;    // of the factor and of what making it takes (LinearSolver::bytes())
  std::size_t entries = 0;  // of the pattern
};

// More than that of the maps of degree `degree` of these faces: by their number, for surfaces of
// few handles. degree >= 2.
FactorSize factor_size_at_most(const SurfaceMesh& mesh, int degree);
// The same of a map that nothing holds, about: costs an analysis.
FactorSize factor_size(const SurfaceMesh& mesh, int degree);

// The memory that the solvers of one process take, and that there is: bytes.
struct SolverMemory {
  std::size_t direct = 0, multigrid = 0;  // with all that they need besides the matrix
  std::optional<std::size_t> available;   // none: nobody says, and all fits

  bool fits_direct() const { return !available || direct <= *available; }
  // Direct is the fastest that fits. Of two that do not fit, what takes less.
  bool prefers_multigrid() const { return !fits_direct() && multigrid < direct; }
};

// The environment's MAJORANT_MULTIGRID_BYTES, for tests, replaces the estimate for multigrid.
SolverMemory solver_memory(const FactorSize& needed, std::optional<std::size_t> available);
// The same for a problem that is not made yet, and will have taken a part of what is available by
// then.
SolverMemory foreseen_memory(const FactorSize& needed, std::optional<std::size_t> available);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
