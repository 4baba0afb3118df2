// Splits the polygons of a file into triangles.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/polygon_mesh.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// Triangles over the vertices of a PolygonMesh.
struct TriangleList {
  std::vector<std::array<Index, 3>> triangles;
  std::vector<Index> polygon;               // by triangle
  std::vector<std::array<int, 3>> corners;  // by triangle: corner numbers within the polygon
};

// The treatment of a polygon of thousands of corners that crosses itself (triangulate_polygon).
enum class Crossing { Refused, Fanned };

// Returns the triangles of polygon p, as corner numbers: those of its shape in space. Other
// triangles are chosen if the polygon's texture coordinates turn one of these over, or give it no
// area, while the others are oriented alike. Throws Error(Unsupported) with the place of the
// polygon, and Stopped.
std::vector<std::array<int, 3>> triangles_of(const PolygonMesh& input, Index p, Crossing crossing,
                                             const StopCheck& stop);

// Returns the triangles of all polygons, in their order.
TriangleList triangulate(const PolygonMesh& input, Crossing crossing, const StopCheck& stop);

// Writes the texture coordinates of the triangles' corners to `parts`, whose faces are these
// triangles, if every corner of the file has one.
void place_texcoords(const PolygonMesh& input, const TriangleList& list, SurfaceParts& parts);

// Returns "mesh.obj:12: face 7: " (line known), "mesh.obj: face 7: ", or "face 6: " for arrays.
std::string face_place(const PolygonMesh& input, Index polygon);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
