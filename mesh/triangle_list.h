// The triangles that the polygons of a file become.
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

// Triangles of polygon p, corner numbers: those of its shape in space, unless its texture
// coordinates turn one of them over, or leave it no area, and other triangles have one orientation.
// Throws Error(Unsupported) with the place of the polygon; Stopped.
std::vector<std::array<int, 3>> triangles_of(const PolygonMesh& input, Index p, Crossing crossing,
                                             const StopCheck& stop);

// The triangles of all polygons, in their order.
TriangleList triangulate(const PolygonMesh& input, Crossing crossing, const StopCheck& stop);

// Texture coordinates of the corners of the triangles, which are the faces of `parts`; nothing
// unless every corner of the file has one.
void place_texcoords(const PolygonMesh& input, const TriangleList& list, SurfaceParts& parts);

// "mesh.obj:12: face 7: " (line known), "mesh.obj: face 7: ", or "face 6: " of arrays.
std::string face_place(const PolygonMesh& input, Index polygon);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
