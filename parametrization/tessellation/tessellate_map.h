// A map of any degree as a textured mesh with straight edges, valid as it stands: for writers of
// formats without curves.
//
//   PolygonMesh mesh = tessellate_map(file, &polygons, {.refine = 1});
//
// Cells whose corners span a positive triangle in the plane stay one triangle; others are cut, and
// their neighbours along the edges concerned, until every triangle is positive and the triangles
// around every inner vertex turn once, proven on the doubles of the result. Its
// surface is that of the map: new vertices lie on the flat triangles, the two sides of an edge
// share them, also along cuts. In the plane there are no T-junctions but where the map is cut.
//
// Not for formats that keep curves: write_vtu() loses nothing.
#pragma once

#include <array>
#include <vector>

#include "majorant/maps/map_file.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

enum class Overlap {
  Allowed,
  Excluded  // the straight boundary must not meet itself; of a map that is injective
};

struct TessellationOptions {
  int refine = 1;                      // every cell becomes at least refine x refine triangles
  Overlap overlap = Overlap::Allowed;  // Excluded: for maps that are injective as a whole
};

// A place on a polygon of the input: between three corners of it, with these weights.
struct PlaceOnPolygon {
  std::array<std::size_t, 3> corners;
  Barycentric weights;
};

// The polygon of the input that one of the result is, or is a piece of, and where its corners are.
struct PolygonOrigin {
  Index polygon = 0;
  std::vector<PlaceOnPolygon> corners;
};

// `input`: the mesh that the map was made from, or null. The result has its vertices (also
// unreferenced ones), then new ones; its polygons in their order, with groups, materials, normals
// and colours. A polygon stays as it is where none of its cells is cut, no cut of the surface
// crosses it, its image is a simple polygon and programs that cut it otherwise see the same
// (is_unfolded_cut_from); otherwise its triangles take its place, in the order of cells. Normals
// and colours at new vertices are interpolated. A polygon whose cells run backwards around it (the
// map has its other side up) is written as they run. Polygons without cells, of a map that is not
// complete, stay without texture coordinates. Without `input` (null): the triangles of
// mesh_from_map in their order.
//
// Texture coordinates: one per corner point of the map in the order of the map's points, then those
// of new vertices. A map of degree 1 with refine = 1 is taken as it is, whether positive or not.
//
// Throws Error(Usage) if refine < 1 or the result needs more than 2^31 vertices, Error(Invalid) if
// the map does not belong to `input`, or naming cells for which no such triangles are found.
// origins, if given: one per polygon of the result; none without input.
PolygonMesh tessellate_map(const MapFile& map, const PolygonMesh* input,
                           const TessellationOptions& options = {},
                           std::vector<PolygonOrigin>* origins = nullptr);

// The polygons of the input of more than three corners that the result has pieces in place of.
std::vector<Index> split_polygons(const MapFile& map, const PolygonMesh& input,
                                  const TessellationOptions& options = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
