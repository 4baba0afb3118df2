#include "majorant/apps/jobs/machine_memory.h"

#include <algorithm>
#include <cstdlib>

#include "majorant/elements/bernstein_space.h"
#include "majorant/framework/assembly.h"
#include "majorant/framework/linear_solver.h"

namespace majorant {
namespace {

// The memory of cg-hypre: PETSc itself, and bytes of matrix and multigrid for each entry of the
// pattern. bench/linear_solvers.py measures 105 to 125 bytes an entry.
constexpr std::size_t kMultigridBytes = 35000000, kMultigridBytesOfEntry = 115;

// The bytes of a problem and its tables for each entry of its pattern, from the sizes of processes
// at degrees 1 to 3.
constexpr std::size_t kProblemBytesOfEntry = 33;

// An upper bound on the bytes of a factor and its making for each entry of the Hessians of faces,
// from degree 2 on. The bytes grow with the logarithm of the number of faces: 35 to 38 at 10,000
// faces, 10 to 12 more for every fourfold number, 110 at the largest pattern.
constexpr std::size_t kFactorBytesOfEntry = 120;

}  // namespace

FactorSize factor_size_at_most(const SurfaceMesh& mesh, int degree) {
  const auto local = static_cast<std::size_t>((degree + 1) * (degree + 2));
  const std::size_t entries = to_size(mesh.face_count()) * (local * (local + 1) / 2);
  return {kFactorBytesOfEntry * entries, entries};
}

FactorSize factor_size(const SurfaceMesh& mesh, int degree) {
  const BezierTriangleSpace space(mesh.faces(), mesh.vertex_count(), degree);
  const ElementDofs element_dofs{space.cells(), 2};
  const SparsePattern pattern =
      reduced_pattern({&element_dofs}, Elimination(2 * space.node_count(), ConstraintRows{}));
  const auto solver = make_direct_solver();
  solver->analyze(pattern);
  return {solver->bytes(), pattern.rows.size()};
}

SolverMemory solver_memory(const FactorSize& needed, std::optional<std::size_t> available) {
  const char* const override_bytes = std::getenv("MAJORANT_MULTIGRID_BYTES");
  return {needed.bytes,
          override_bytes ? std::strtoull(override_bytes, nullptr, 10)
                         : kMultigridBytes + kMultigridBytesOfEntry * needed.entries,
          available};
}

SolverMemory foreseen_memory(const FactorSize& needed, std::optional<std::size_t> available) {
  if (available) *available -= std::min(*available, kProblemBytesOfEntry * needed.entries);
  return solver_memory(needed, available);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
