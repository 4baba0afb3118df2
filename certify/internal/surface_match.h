// Are the cells of a map the faces of a surface? Decided from vertices and positions, for maps on
// the surface's own faces, on pieces of them (a tessellation) or on other triangles of its flat
// parts.
//
//   const SurfaceMatch match = match_surface(*mesh, read_mesh("bunny.obj"));
//   if (!match.defect.empty()) ...                         // "face 7 is mapped by no cell"
//
// Edges of the surface that the mesh of the cells has too, whole or as a chain of edges on the
// straight line, cut both into patches. Patches with the same edges around them are compared: the
// corners of one polygon with n - 2 triangles over them are a triangulation of it; otherwise both
// must lie in one plane, all triangles turned the same way and with the same area in all, so that
// both cover what their common edges enclose, once.
#pragma once

#include <string>
#include <vector>

#include "majorant/mesh/polygon_mesh.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

struct SurfaceMatch {
  std::string defect;  // one line naming a face, edge or vertex of the surface (from 0); or empty
  // Counts of what is compared: faces of the surface that are single cells or triangulated
  // polygons, and faces that were cut into pieces or joined with others of their plane.
  Index same = 0, changed = 0;
};

// cells: vertices of the surface have its numbers as input_vertex(); others are new. face_of_cell:
// what the file says, the face each cell belongs to, or empty; where it says so, there are no new
// vertices. Positions may be off by 1e-9 of the surface's size, and by `rounding` of the cells.
// unmapped: flags of faces of the surface that have no cells, as if they were not there, or empty.
SurfaceMatch match_surface(const SurfaceMesh& cells, const PolygonMesh& surface,
                           const std::vector<Index>& face_of_cell = {}, double rounding = 0,
                           const std::vector<char>& unmapped = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
