// The flip of an edge between two triangles of a half-edge mesh: the other diagonal of their
// quadrilateral takes the numbers of the edge's half-edges.
//
//   Cells faces = mesh->faces();
//   std::vector<Index> opposite = mesh->opposites();
//   const FlippedSides moved = flip_half_edge(faces, opposite, 12);   // how half-edge data move
#pragma once

#include <array>
#include <vector>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// The numbers of a quadrilateral's sides before and after the flip of its diagonal, in the same
// order: bc, ca, ad, db. Data stored by half-edge must be moved from `from` to `to`.
struct FlippedSides {
  std::array<Index, 4> from, to;
};
FlippedSides flipped_sides(Index half_edge, Index opposite);

// faces: #F by 3; opposite: 3 #F, negative on the boundary, but not at half_edge. Shapes are not
// checked. A side that is glued to another side of the quadrilateral moves with it.
FlippedSides flip_half_edge(Cells& faces, std::vector<Index>& opposite, Index half_edge);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
