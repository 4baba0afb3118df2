// Cells compared face by face with a surface that repair() has to take apart: flipped or duplicate
// faces, fins, pinched vertices, soups.
//
//   SurfaceMatch match = match_along_edges({*mesh}, polygons);
//   if (!match.defect.empty())
//     match = match_faces({*mesh}, polygons, Orientation::MadeConsistent).value_or(match);
//
// Polygons of the file are compared with those of the surface first, as cycles of places: files cut
// them along diagonals of their own, which may coincide with edges of other polygons. Where two
// quads share two edges, a reader may cut both along the diagonal that closes these.
//
// Then, face by face, no edges of the surface are followed: every polygon must have the cells that
// repair() makes of it, turned where repair() turns them, or, if all of it lies one way round,
// another triangulation of its corners, or pieces of these faces: cells that hang together within
// the face, up to its sides, and have its area.
#pragma once

#include <optional>

#include "majorant/certify/internal/surface_match.h"

namespace majorant {

// input_vertex() of the cells is a vertex of the surface; where repair() opens that, or one exactly
// where it is: slits do not count then. Nothing where repair() neither splits, turns, cuts nor
// welds and the cells are not its faces: match_along_edges() says more of these.
std::optional<SurfaceMatch> match_faces(const ShownCells& cells, const PolygonMesh& surface,
                                        Orientation orientation);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
