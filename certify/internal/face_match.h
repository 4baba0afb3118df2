// Compares cells, face by face, with a surface that repair() takes apart: flipped or duplicate
// faces, fins, pinched vertices, soups.
//
//   SurfaceMatch match = match_along_edges({*mesh}, polygons);
//   if (!match.defect.empty())
//     match = match_faces({*mesh}, polygons, Orientation::MadeConsistent).value_or(match);
//
// Polygons of the file are first compared with those of the surface as cycles of places. Files may
// cut polygons along other diagonals, which may coincide with edges of other polygons. If two quads
// share two edges, a reader may cut both along the diagonal that closes these.
//
// Then every polygon must have the cells that repair() makes of it, turned over where repair() does
// that. If all its faces have one orientation, it may have another triangulation of its corners. It
// may also have pieces of these faces: connected cells within the face, up to its sides, with its
// area.
#pragma once

#include <optional>

#include "majorant/certify/internal/surface_match.h"

namespace majorant {

// input_vertex() of the cells is a vertex of the surface. Where repair() opens the surface, it may
// be another vertex at exactly the same place; slits do not count then. Returns nothing if repair()
// changes nothing and the cells are not its faces: match_along_edges() tells more then.
std::optional<SurfaceMatch> match_faces(const ShownCells& cells, const PolygonMesh& surface,
                                        Orientation orientation);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
