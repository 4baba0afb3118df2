#include "distributed/internal/petsc_matrix.h"

#include <petscmat.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "distributed/internal/petsc_call.h"
#include "majorant/framework/error.h"

namespace majorant {
namespace {

PetscInt petsc_index(GlobalIndex i) { return static_cast<PetscInt>(i); }

// Unknowns of a node, where all nodes of all ranks have as many (u and v of a map; a line that is
// held has fewer); else 1. Collective.
PetscInt block_size(const SparsePattern& pattern, const Partition& partition) {
  Index most = 1;
  for (Index i = 0, first = 0; i < pattern.size; ++i) {
    if (pattern.block_of[i] != pattern.block_of[first]) first = i;
    most = std::max(most, i - first + 1);
  }
  most = static_cast<Index>(partition.ranks().max(most));
  bool regular = pattern.size % most == 0;
  for (Index i = 0; i < pattern.size && regular; ++i)
    regular = pattern.block_of[i] == i / most && partition.owns(i) == partition.owns(i - i % most);
  return partition.ranks().all(regular) ? most : 1;
}

}  // namespace

PetscMatrix::PetscMatrix(const SparsePattern& pattern, const Partition& partition)
    : pattern_(pattern), partition_(partition) {
  if (partition.global_size() > std::numeric_limits<PetscInt>::max())
    throw Error(ErrorKind::Unsupported,
                "the problem has more unknowns than the integers of this PETSc count; use a PETSc "
                "with 64-bit integers (petsc64-dev)");
  if (2 * pattern.rows.size() > static_cast<std::size_t>(std::numeric_limits<PetscInt>::max()))
    throw Error(ErrorKind::Unsupported,
                "the matrix of a rank has more entries than the integers of this PETSc count; use "
                "more ranks, or a PETSc with 64-bit integers (petsc64-dev)");
  // Both triangles, entry by entry of the pattern; PETSc adds those of one place, of other ranks
  // too.
  std::vector<PetscInt> rows, columns;
  rows.reserve(2 * pattern.rows.size());
  columns.reserve(2 * pattern.rows.size());
  const auto add = [&](Index row, Index column) {
    rows.push_back(petsc_index(partition.global(row)));
    columns.push_back(petsc_index(partition.global(column)));
  };
  for (Index c = 0; c < pattern.size; ++c)
    for (Index k = pattern.column_starts[c]; k < pattern.column_starts[c + 1]; ++k) {
      const Index r = pattern.rows[k];
      add(r, c);
      if (r != c) add(c, r);
    }
  const PetscInt owned = partition.owned_size(), all = petsc_index(partition.global_size());
  require_petsc(MatCreate(PETSC_COMM_WORLD, &mat_));
  require_petsc(MatSetSizes(mat_, owned, owned, all, all));
  // Multigrid keeps u and v apart then: what makes one level out of both takes 53 instead of 6
  // conjugate gradients to 1e-2 (nefertiti_10000, tenth step).
  require_petsc(MatSetBlockSize(mat_, block_size(pattern, partition)));
  require_petsc(MatSetType(mat_, MATAIJ));
  require_petsc(MatSetPreallocationCOO(mat_, static_cast<PetscCount>(rows.size()), rows.data(),
                                       columns.data()));
  require_petsc(MatSetOption(mat_, MAT_SYMMETRIC, PETSC_TRUE));
  require_petsc(MatSetOption(mat_, MAT_SYMMETRY_ETERNAL, PETSC_TRUE));
  require_petsc(MatCreateVecs(mat_, &p_, &r_));
}

PetscMatrix::~PetscMatrix() {
  VecDestroy(&p_);
  VecDestroy(&r_);
  MatDestroy(&mat_);
}

void PetscMatrix::set(const Vec& values, double shift) {
  entries_.clear();
  for (Index c = 0; c < pattern_.size; ++c)
    for (Index k = pattern_.column_starts[c]; k < pattern_.column_starts[c + 1]; ++k) {
      entries_.push_back(values[k]);
      if (pattern_.rows[k] != c) entries_.push_back(values[k]);
    }
  require_petsc(MatSetValuesCOO(mat_, entries_.data(), INSERT_VALUES));
  if (shift != 0) require_petsc(MatShift(mat_, shift));
}

void PetscMatrix::to_petsc(const Vec& from, ::Vec to) const {
  PetscScalar* entries = nullptr;
  require_petsc(VecGetArrayWrite(to, &entries));
  for (Index i = 0; i < partition_.size(); ++i)
    if (partition_.owns(i)) *entries++ = from[i];
  require_petsc(VecRestoreArrayWrite(to, nullptr));
}

void PetscMatrix::from_petsc(::Vec from, Vec& to) const {
  const PetscScalar* entries = nullptr;
  require_petsc(VecGetArrayRead(from, &entries));
  to.setZero(partition_.size());
  const PetscScalar* entry = entries;
  for (Index i = 0; i < partition_.size(); ++i)
    if (partition_.owns(i)) to[i] = *entry++;
  require_petsc(VecRestoreArrayRead(from, &entries));
  partition_.copy_from_owners(to);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
