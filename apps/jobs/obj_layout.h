// What the lines of an OBJ say of a layout: a material for every tile, a group for every chart, a
// name for every object.
//
//   const std::vector<int> chart = chart_of_polygons(file, polygons);
//   PolygonMesh marked = with_tile_materials(polygons, chart);       // usemtl 1001 ...
//   marked = with_chart_groups(std::move(marked), chart);            // g wheel chart_0
//   write_map("out.obj", file, &marked, {});
//
// A polygon that a cut crosses has the tile and the chart of its first cell.
#pragma once

#include <string>
#include <vector>

#include "majorant/io/mesh_objects.h"
#include "majorant/maps/map_file.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

// Returns the chart of each polygon of the mesh that `file` was made from; -1 where it has no cell.
std::vector<int> chart_of_polygons(const MapFile& file, const PolygonMesh& polygons);

// `usemtl 1001` and so on before the first polygon of every run in one tile. Materials of the input
// and files of them are left out: a tile has one. tile: by polygon, from 0; -1: as the one before.
PolygonMesh with_tile_materials(PolygonMesh polygons, const std::vector<int>& tile);

// `g ... chart_0` and so on before the first polygon of every run in one chart, behind the names of
// the groups that the input has there. chart: by polygon; -1: as the one before.
PolygonMesh with_chart_groups(PolygonMesh polygons, const std::vector<int>& chart);

// `o NAME` before the first polygon of every run of one object, in place of those that are there,
// whose names they keep: those of other objects with a number, so that names tell objects apart.
PolygonMesh with_object_names(PolygonMesh polygons, const MeshObjects& objects);

// The material of every polygon, as `usemtl` names it; empty where there is none.
std::vector<std::string> material_of_polygons(const PolygonMesh& polygons);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
