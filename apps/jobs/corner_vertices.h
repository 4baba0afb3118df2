// A map of a surface whose vertices were joined for it, with the vertices of its input again.
//
//   if (const auto named = with_corner_vertices(file, polygons)) write_vtu(path, *named);
//
// Where edges between vertices at equal places were joined (mesh/repair.h), cells on their two
// sides share points, and a point names one vertex of the input. A file that is to fit the input
// one for one has a point for every vertex there.
#pragma once

#include <optional>

#include "majorant/maps/map_file.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

// The map with more points: every corner of a cell names the vertex that the polygon of the cell
// has there, at the same place with the same uv. None where that is so already, or input_vertex and
// input_face are not known.
std::optional<MapFile> with_corner_vertices(const MapFile& map, const PolygonMesh& input);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
