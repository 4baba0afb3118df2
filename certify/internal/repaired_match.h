// Are the cells of a map the faces of a surface that repair() has to take apart? For meshes that
// are no surface as their file has them: flipped or duplicate faces, fins, pinched vertices, soups.
//
//   std::vector<Index> labels;   // #F: the polygon of each
//   SurfaceMatch match = match_surface(*mesh, polygons, labels);
//   if (!match.defect.empty())
//     match = match_repaired(*mesh, polygons, labels).value_or(match);
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
#include <vector>

#include "majorant/certify/internal/surface_match.h"
#include "majorant/mesh/repair.h"

namespace majorant {

// cells: input_vertex() is a vertex of the surface; where repair() opens that, or one exactly where
// it is: slits do not count then; others are new. face_of_cell: #F, what the file says, the polygon
// of each, or empty; where it says so, there are no new vertices and no pieces. orientation: as
// repair() takes it. Nothing where repair() neither splits, turns, cuts nor welds and the cells are
// not its faces: match_surface() says more of these. Positions, rounding and unmapped as there.
// polygon_of_cell: #F, which cells are one polygon of the file, whatever its number in the surface;
// or empty.
std::optional<SurfaceMatch> match_repaired(const SurfaceMesh& cells, const PolygonMesh& surface,
                                           const std::vector<Index>& face_of_cell,
                                           Orientation orientation = Orientation::MadeConsistent,
                                           double rounding = 0,
                                           const std::vector<char>& unmapped = {},
                                           const std::vector<Index>& polygon_of_cell = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
