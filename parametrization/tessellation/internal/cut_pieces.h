// Cuts the pieces of a map until they are a valid piecewise linear map, proven on their doubles.
//
//   MapPieces pieces(file, corner_mesh(file, ""), 1);
//   cut_until_positive(pieces, Overlap::Allowed);
//
// Afterwards every piece is positive in the plane (exact_predicates.h), and around every vertex
// inside the plane the pieces turn once. Positive pieces change only if an edge that they share
// with another piece is cut.
//
// A piece that is not positive is repaired by flipping an edge to a neighbour in the same cell, if
// both become positive. Otherwise one of its edges is halved if that leaves fewer pieces that are
// not positive: the edge that leaves fewest, then the one with the best shaped pieces on the
// surface. If no single cut helps, and always at large depth, its longest edge is halved, after
// that of its neighbour while that one is longer [Riv97].
//
// Lengths are measured in the plane, on the curves. Where a map stretches a hundredfold in one
// direction, few pieces suffice that are round there, but thousands that are round on the surface.
// On fine pieces the map is nearly affine, and halving longest edges bounds the angles of their
// images from below; so pieces become positive wherever the map is locally injective.
//
// The functions below find pieces that overlap in the plane though each of them is positive: around
// a vertex, and along the boundary. They are exact.
#pragma once

#include <vector>

#include "majorant/parametrization/tessellation/internal/map_pieces.h"
#include "majorant/parametrization/tessellation/tessellate_map.h"

namespace majorant {

// Cuts the pieces. Excluded: also cuts boundary edges that meet others, and edges of components
// whose images lie inside one another. By the theorem of global_injectivity.h the result is
// injective. Throws Error(Invalid) that names cells where doubles do not suffice, or where the map
// is not (locally) injective.
void cut_until_positive(MapPieces& pieces, Overlap overlap);

// Returns the edges that leave those vertices inside the plane around which the pieces do not turn
// exactly once. All pieces must be positive.
std::vector<MapPieces::Edge> spokes_of_wound_vertices(const MapPieces& pieces);

struct BoundaryEdge {
  MapPieces::Edge edge;  // the piece on its left
  Index from, to;        // texture coordinates
};
// Returns the edges of pieces without a neighbour in the plane: on the surface's boundary and on
// both sides of cuts.
std::vector<BoundaryEdge> boundary_edges(const MapPieces& pieces);

// Returns indices of edges to be halved, none if the pieces do not overlap. Pieces that are
// positive and turn once do not overlap if boundary edges meet only at common ends and no component
// lies inside another (global_injectivity.h).
//
// Of two edges that meet, returns those whose distance from their curve exceeds a quarter of the
// other's; of nested components, all edges around them. If all of these are straight, all are
// returned, though halving does not help.
std::vector<Index> edges_to_cut(const MapPieces& pieces, const std::vector<BoundaryEdge>& edges);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
