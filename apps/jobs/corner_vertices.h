// Restores the vertices of the input on a map of a surface whose vertices were joined.
//
//   if (const auto named = with_corner_vertices(file, polygons)) write_vtu(path, *named);
//
// If edges between vertices at equal places were joined (mesh/repair.h), the cells on both sides
// share points, and each point names only one vertex of the input. A file that fits the input one
// for one needs a point for every vertex.
#pragma once

#include <optional>

#include "majorant/maps/map_file.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

// Returns the map with more points: every corner of a cell names the vertex that the cell's polygon
// has there, with the same place and uv. None if that holds already, or if input_vertex and
// input_face are unknown.
std::optional<MapFile> with_corner_vertices(const MapFile& map, const PolygonMesh& input);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
