#include "majorant/results/internal/machine_memory.h"

#include <algorithm>
#include <cstdlib>

namespace majorant {
namespace {

// What cg-hypre takes: PETSc itself, and its matrix and multigrid for every entry of the pattern.
// Origin: bench/linear_solvers.py, its peak beyond that of direct without the factor: nefertiti cut
// finer, 10K faces at degrees 1 to 3 and 40K at degree 1, from 105 to 125 bytes for each entry.
constexpr std::size_t kMultigridBytes = 35000000, kMultigridBytesOfEntry = 115;

// What a problem takes for every entry of its pattern, its tables among them. Origin: the process
// at the analysis of degrees 2 and 3 of nefertiti_10000, over that at degree 1.
constexpr std::size_t kProblemBytesOfEntry = 33;

}  // namespace

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
