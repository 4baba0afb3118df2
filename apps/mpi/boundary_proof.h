// Proves that a distributed map is globally injective. Rank 0 does this from the boundary curves of
// all ranks (certify/global_injectivity.h), O(sqrt #F) curves.
//
//     const BoundaryOrder order(whole_mesh, rank_of_face);       // rank 0; default elsewhere
//     const GlobalInjectivity proof = prove_boundary(part, map, order);
#pragma once

#include <vector>

#include "apps/mpi/mesh_part.h"
#include "majorant/certify/global_injectivity.h"

namespace majorant {

// The places in the ranks' lists of the boundary half-edges of the surface, loop by loop, for rank
// 0.
class BoundaryOrder {
 public:
  struct Place {
    int rank;
    Index place;      // in that rank's boundary_half_edges
    Index half_edge;  // of the surface
  };
  BoundaryOrder() = default;
  BoundaryOrder(const SurfaceMesh& mesh, const std::vector<int>& rank_of_face);
  const std::vector<std::vector<Place>>& loops() const { return loops_; }

 private:
  std::vector<std::vector<Place>> loops_;
};

// Collective; the result is valid on rank 0. The surface must be connected.
GlobalInjectivity prove_boundary(const MeshPart& part, const BezierMap& map,
                                 const BoundaryOrder& order);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
