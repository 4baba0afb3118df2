#include "majorant/apps/jobs/machine_memory.h"

#include <algorithm>
#include <cstdlib>

#include "majorant/elements/bernstein_space.h"
#include "majorant/framework/assembly.h"
#include "majorant/framework/linear_solver.h"

namespace majorant {
namespace {

// The memory of cg-hypre: PETSc itself, and its matrix and multigrid for every entry of the
// pattern: the peak beyond that of direct without the factor (bench/linear_solvers.py) is 105 to
// 125 bytes for each entry of 10K faces at degrees 1 to 3 and of 40K at degree 1.
constexpr std::size_t kMultigridBytes = 35000000, kMultigridBytesOfEntry = 115;

// The bytes of a problem for every entry of its pattern, its tables among them: the size of the
// process at the analysis of degrees 2 and 3 of 10K faces, over that at degree 1.
constexpr std::size_t kProblemBytesOfEntry = 33;

// The bytes of a factor and its making for every entry of the Hessians of faces, from degree 2 on:
// at most: 10K faces take 35 at degree 3 and 38 at degree 2, and 10 and 12 more for every fourfold
// number of faces, 87 and 110 where patterns end.
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
  const char* const told = std::getenv("MAJORANT_MULTIGRID_BYTES");
  return {needed.bytes,
          told ? std::strtoull(told, nullptr, 10)
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
