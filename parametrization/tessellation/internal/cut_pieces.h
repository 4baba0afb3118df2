// Cuts the pieces of a map until they are a valid piecewise linear map, proven on their doubles.
//
//   MapPieces pieces(file, corner_mesh(file, ""), 1);
//   cut_until_positive(pieces, Overlap::Allowed);
//
// Afterwards every piece is positive in the plane (exact_predicates.h), and around every vertex
// inside the plane the pieces turn once. Pieces that are positive stay as they are, but for edges
// that they share with others that are not.
//
// A piece that is not positive is repaired by the other diagonal of it and its neighbour, if they
// are of one cell and both become positive; else one of its edges is halved where that leaves fewer
// pieces that are not positive (the fewest; then the best shaped ones on the surface). Where no
// single cut helps, and deep down always, its longest edge is halved, after that of its
// neighbour while that one is longer [Riv97]. Lengths are measured in the plane, on the curves:
// where a map stretches a hundredfold in one direction, pieces that are round there are few, pieces
// that are round on the surface are thousands. As they become fine the map is affine on each, and
// halving longest edges keeps the angles of their images from below; so pieces are positive in the
// end wherever the map is locally injective.
//
// Finds pieces of a map that meet each other in the plane though each of them is positive: around a
// vertex, and along the boundary. Exact.
#pragma once

#include <vector>

#include "majorant/parametrization/tessellation/internal/map_pieces.h"
#include "majorant/parametrization/tessellation/tessellate_map.h"

namespace majorant {

// Excluded: boundary edges that meet others, or images of components that lie in another one, are
// cut too. By the theorem of global_injectivity.h the result is injective.
// Throws Error(Invalid) that names cells where doubles do not suffice, or where the map is not
// (locally) injective.
void cut_until_positive(MapPieces& pieces, Overlap overlap);

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
