// Do the cells of a file show a surface? For maps on the surface's own faces, on pieces of them (a
// tessellation) or on other triangles of its flat parts.
//
//   const SurfaceMatch match = match_surface({*mesh}, read_mesh("bunny.obj"));
//   if (!match.defect.empty()) ...                         // "face 7 is mapped by no cell"
//
// Cells are compared along the edges of the surface (edge_match.h); where that fails and the
// surface is none as its file has it, face by face with what repair() makes of it (face_match.h).
//
// Not for quads over a surface (quads/check_quads.h): these have vertices of their own, next to it,
// and are compared by distances and along its border and features alone.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "majorant/mesh/polygon_mesh.h"
#include "majorant/mesh/repair.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// The cells of a file, and what that says of them. What it refers to outlives it.
struct ShownCells {
  // Vertices of the surface have its numbers as input_vertex(); others are new.
  const SurfaceMesh& mesh;
  // #F: the face of the surface that each cell is said to belong to, or empty. There are no new
  // vertices and no pieces of faces then.
  const std::vector<Index>& face = kNothing;
  // #F: which cells are one polygon of the file, whatever its number in the surface; or empty.
  const std::vector<Index>& polygon = kNothing;
  // Flags of faces of the surface that have no cells, as if they were not there; or empty.
  const std::vector<char>& unmapped = kNoFlags;
  // Positions may be off by 1e-9 of the surface's size, and by so much, in model units.
  double rounding = 0;

  bool is_mapped(Index surface_face) const { return unmapped.empty() || !unmapped[surface_face]; }

  static const std::vector<Index> kNothing;
  static const std::vector<char> kNoFlags;
};

struct SurfaceMatch {
  std::string defect;  // one line naming a face, edge or vertex of the surface (from 0); or empty
  // Counts of what is compared: faces of the surface that are single cells or triangulated
  // polygons, and faces that were cut into pieces or joined with others of their plane.
  Index same = 0, changed = 0;
};

// orientation: as repair() takes it. The defect is that of edge_match.h where repair() changes
// nothing, else that of face_match.h.
SurfaceMatch match_surface(const ShownCells& cells, const PolygonMesh& surface,
                           Orientation orientation = Orientation::MadeConsistent);

// ---- For both ways of comparing ----

// The distance below which a vertex of the cells and one of the surface are at one place.
double match_distance(const ShownCells& cells, const PolygonMesh& surface);

// The vertices of the surface that vertices of the cells are.
struct NamedVertices {
  static constexpr Index kNew = -1;
  std::vector<Index> of_cells;  // by vertex of the cells, kNew where the surface lacks it
  std::string defect;           // of the first that is elsewhere in the surface, or may not be new
};
// is_used: by vertex of the surface, whether it is one for the cells. close: match_distance().
NamedVertices name_vertices(const ShownCells& cells, const PolygonMesh& surface,
                            const std::vector<char>& is_used, double close);

// Half the sum of the cross products of a polygon's sides: its area times its normal.
Vector3 area_vector(std::span<const Vector3> corners);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
