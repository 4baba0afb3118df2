#include <petscmat.h>

#include <cstdlib>

#include "distributed/internal/petsc_call.h"
#include "distributed/mesh_part.h"

namespace majorant {
namespace {

// PTScotch divides on as many threads as the machine has, and then not the same way in every run.
void divide_on_one_thread() { setenv("SCOTCH_PTHREAD_NUMBER", "1", 1); }

}  // namespace

// The dual graph on rank 0: a row a face, an entry a neighbour across an edge.
std::vector<int> face_ranks(const SurfaceMesh& mesh, int count) {
  std::vector<int> ranks(to_size(mesh.face_count()), 0);
  if (count == 1) return ranks;
  if (mesh.face_count() <= count) {  // one each; others have none
    for (std::size_t f = 0; f < ranks.size(); ++f) ranks[f] = static_cast<int>(f);
    return ranks;
  }
  const PetscInt faces = mesh.face_count();
  PetscInt *starts = nullptr, *neighbours = nullptr;  // freed by the matrix
  require_petsc(PetscMalloc1(faces + 1, &starts));
  require_petsc(PetscMalloc1(3 * faces, &neighbours));
  PetscInt filled = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    starts[f] = filled;
    for (Index k = 0; k < 3; ++k)
      if (const Index o = mesh.opposite(3 * f + k); o >= 0) neighbours[filled++] = o / 3;
  }
  starts[faces] = filled;
  Mat graph = nullptr;
  MatPartitioning partitioning = nullptr;
  IS of_faces = nullptr;
  divide_on_one_thread();
  require_petsc(
      MatCreateMPIAdj(PETSC_COMM_SELF, faces, faces, starts, neighbours, nullptr, &graph));
  require_petsc(MatPartitioningCreate(PETSC_COMM_SELF, &partitioning));
  require_petsc(MatPartitioningSetAdjacency(partitioning, graph));
  require_petsc(MatPartitioningSetType(partitioning, MATPARTITIONINGPTSCOTCH));
  require_petsc(MatPartitioningSetNParts(partitioning, count));
  require_petsc(MatPartitioningApply(partitioning, &of_faces));
  const PetscInt* parts = nullptr;
  require_petsc(ISGetIndices(of_faces, &parts));
  for (std::size_t f = 0; f < ranks.size(); ++f) ranks[f] = static_cast<int>(parts[f]);
  require_petsc(ISRestoreIndices(of_faces, &parts));
  ISDestroy(&of_faces);
  MatPartitioningDestroy(&partitioning);
  MatDestroy(&graph);
  return ranks;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
