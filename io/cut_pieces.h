// Cuts the pieces of a map until they are a valid piecewise linear map, proven on their doubles.
//
//   MapPieces pieces(map, mesh_from_map(map, ""), 1);
//   cut_until_positive(pieces, Overlap::Allowed);
//
// Afterwards every piece is positive in the plane (exact_predicates.h), and around every vertex
// inside the plane the pieces turn once. Pieces that are positive stay as they are, but for edges
// that they share with others that are not.
//
// A piece that is not positive is repaired by the other diagonal of it and its neighbour, if they
// are of one cell; else one of its edges is halved: the one that leaves the fewest pieces that are
// not positive, then the one that makes the fewest and the best shaped ones on the surface. That
// works within a few cuts or not at all, so deeper pieces halve their longest edge, and before it
// that of the neighbour while it is longer [Riv84]. Lengths are measured in equilateral cells,
// where that keeps the angles of pieces from below: fine enough pieces are positive wherever the
// map is locally injective.
#pragma once

#include "majorant/io/map_pieces.h"

namespace majorant {

enum class Overlap {
  Allowed,
  Excluded  // the straight boundary must not meet itself; of a map that is injective
};

// Excluded: boundary edges that meet others, or images of components that lie in another one, are
// cut too. By the theorem of global_injectivity.h the result is injective.
// Throws Error(Invalid) that names cells where doubles do not suffice, or where the map is not
// (locally) injective.
void cut_until_positive(MapPieces& pieces, Overlap overlap);

}  // namespace majorant
