// Proves that a map in parts is injective as a whole: rank 0 does, from the boundary curves of all
// ranks (certify/global_injectivity.h), which are O(sqrt #F) of them.
//
//     const BoundaryOrder order(whole_mesh, rank_of_face);       // rank 0; default elsewhere
//     const GlobalInjectivity proof = prove_boundary(part, map, order);
#pragma once

#include <vector>

#include "apps/mpi/mesh_part.h"
#include "majorant/certify/global_injectivity.h"

namespace majorant {

// The places where rank 0 finds the boundary half-edges of the surface, loop by loop.
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

// Collective; the answer is rank 0's. The surface is connected.
GlobalInjectivity prove_boundary(const MeshPart& part, const BezierMap& map,
                                 const BoundaryOrder& order);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
