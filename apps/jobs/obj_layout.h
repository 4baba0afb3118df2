// Lines of an OBJ that describe a layout: a material for every tile, a group for every chart, a
// name for every object.
//
//   const std::vector<int> chart = chart_of_polygons(file, polygons);
//   PolygonMesh marked = with_tile_materials(polygons, chart);       // usemtl 1001 ...
//   marked = with_chart_groups(std::move(marked), chart);            // g wheel chart_0
//   write_map("out.obj", file, &marked, {});
//
// A polygon that is crossed by a cut belongs to the tile and the chart of its first cell.
#pragma once

#include <string>
#include <vector>

#include "majorant/io/mesh_objects.h"
#include "majorant/maps/map_file.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

// Returns the chart of each polygon of the mesh that `file` was made from; -1: it has no cell.
std::vector<int> chart_of_polygons(const MapFile& file, const PolygonMesh& polygons);

// Adds `usemtl 1001` and so on before the first polygon of every run in one tile. Materials of the
// input and their files are left out. tile: by polygon, from 0; -1: the tile of the previous
// polygon.
PolygonMesh with_tile_materials(PolygonMesh polygons, const std::vector<int>& tile);

// Adds `g ... chart_0` and so on before the first polygon of every run in one chart, after the
// names of the input's groups. chart: by polygon; -1: the chart of the previous polygon.
PolygonMesh with_chart_groups(PolygonMesh polygons, const std::vector<int>& chart);

// Replaces the `o` lines: one `o NAME` before the first polygon of every run of one object.
// Repeated names get a number, so that names distinguish objects.
PolygonMesh with_object_names(PolygonMesh polygons, const MeshObjects& objects);

// Returns the material of every polygon, as `usemtl` names it; empty without a material.
std::vector<std::string> material_of_polygons(const PolygonMesh& polygons);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
