// Decides whether the cells of a file show a surface: its own faces, pieces of them (a
// tessellation), or other triangles of its flat parts.
//
//   const SurfaceMatch match = match_surface({*mesh}, read_mesh("bunny.obj"));
//   if (!match.defect.empty()) ...                         // "face 7 is mapped by no cell"
//
// Cells are compared along the edges of the surface (edge_match.h). If that fails and the surface
// needs repairs, they are compared face by face with what repair() makes of it (face_match.h).
//
// Not for quads over a surface (quads/check_quads.h), whose vertices lie next to it. These are
// compared by distances, and along its border and features.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "majorant/mesh/polygon_mesh.h"
#include "majorant/mesh/repair.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// The cells of a file with their labels. The members' referents must outlive this.
struct ShownCells {
  // input_vertex() is the number of a vertex in the surface; other vertices are new.
  const SurfaceMesh& mesh;
  // #F: the face of the surface that each cell claims to belong to; may be empty. With it there are
  // no new vertices and no pieces of faces.
  const std::vector<Index>& face = kNothing;
  // #F: the polygon of the file that each cell belongs to, whatever its number in the surface; may
  // be empty.
  const std::vector<Index>& polygon = kNothing;
  // Flags of faces of the surface without cells, which are ignored; may be empty.
  const std::vector<char>& unmapped = kNoFlags;
  // Positions may be off by this, in model units, besides 1e-9 of the surface's size.
  double rounding = 0;

  bool is_mapped(Index surface_face) const { return unmapped.empty() || !unmapped[surface_face]; }

  static const std::vector<Index> kNothing;
  static const std::vector<char> kNoFlags;
};

struct SurfaceMatch {
  std::string defect;  // one line naming a face, edge or vertex of the surface (from 0); may be
                       // empty
  // The number of faces of the surface that are single cells or triangulated polygons, and of faces
  // that were cut into pieces or joined with others in their plane.
  Index same = 0, changed = 0;
};

// orientation: see repair(). The defect is that of edge_match.h if repair() changes nothing, else
// that of face_match.h.
SurfaceMatch match_surface(const ShownCells& cells, const PolygonMesh& surface,
                           Orientation orientation = Orientation::MadeConsistent);

// ---- For both ways of comparing ----

// Returns the distance within which a vertex of the cells and one of the surface are at one place.
double match_distance(const ShownCells& cells, const PolygonMesh& surface);

// The vertices of the surface that correspond to vertices of the cells.
struct NamedVertices {
  static constexpr Index kNew = -1;
  std::vector<Index> of_cells;  // by vertex of the cells; kNew if the surface lacks it
  std::string defect;           // of the first vertex at another place than in the surface, or that
                                // may not be new
};
// is_used: flags of the surface's vertices that the cells may have. close: match_distance().
NamedVertices name_vertices(const ShownCells& cells, const PolygonMesh& surface,
                            const std::vector<char>& is_used, double close);

// Returns half the sum of the cross products of a polygon's sides: its area times its normal.
Vector3 area_vector(std::span<const Vector3> corners);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
