// The corner mesh of a map: one triangle per cell, with the uv of the corner points.
//
//   const CornerMesh coarse = corner_mesh(file, "");
//   coarse.vertices(0, 2);   // of the triangle of cell coarse.cell[0] at its corner 2
#pragma once

#include <string>
#include <vector>

#include "majorant/framework/types.h"
#include "majorant/maps/map_file.h"

namespace majorant {

// A triangle mesh of the corner points of cells, without the lists of a PolygonMesh.
struct CornerMesh {
  std::vector<Vector3> positions;
  std::vector<Vector2> texcoords;  // one per corner point of the map, the same for its copies
  std::vector<Index> cell;         // of the map, by triangle
  Cells vertices, texcoord_ids;    // by triangle, three each
};

// Returns the cells of the map with one number for corner points that are copies of each other. A
// file that names several vertices of its input at one place has a point for each
// (corner_vertices.h). Copies are found at the ends of an edge whose inner points two cells share,
// with equal positions and uv. At degree 1 edges have no inner points, and the cells are returned
// as they are.
Cells united_cells(const MapFile& map);

// Returns the mesh of mesh_from_map() (map_file.h), without the lists of a polygon mesh.
CornerMesh corner_mesh(const MapFile& map, const std::string& file);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
