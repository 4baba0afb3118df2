// Where the pieces of a map meet each other in the plane though each of them is positive: around a
// vertex, and along the boundary. Exact.
#pragma once

#include <vector>

#include "majorant/parametrization/tessellation/internal/map_pieces.h"

namespace majorant {

// The edges that leave those vertices inside the plane where the pieces do not turn exactly once.
// All pieces must be positive.
std::vector<MapPieces::Edge> spokes_of_wound_vertices(const MapPieces& pieces);

struct BoundaryEdge {
  MapPieces::Edge edge;  // the piece on its left
  Index from, to;        // texture coordinates
};
// Edges of pieces with nothing on their other side in the plane: of the surface's boundary and of
// both sides of cuts.
std::vector<BoundaryEdge> boundary_edges(const MapPieces& pieces);

// Numbers of edges to be halved, none if the pieces do not overlap: all pieces being positive and
// turning once, that is when no boundary edges meet but at common ends and no component lies within
// another (global_injectivity.h). Of edges that meet, those further away from their curve than a
// quarter of the other's distance; of components within each other, all edges that lead around. If
// all of them are straight, all are returned though it does not help.
std::vector<Index> edges_to_cut(const MapPieces& pieces, const std::vector<BoundaryEdge>& edges);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
