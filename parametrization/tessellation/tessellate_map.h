// A map of any degree as a textured mesh with straight edges, for formats without curves.
//
//   PolygonMesh mesh = tessellate_map(file, &polygons, {.refine = 1});
//
// Cells whose corners span a positive triangle in the plane stay one triangle. Others are cut,
// together with their neighbours along the affected edges, until every triangle is positive and the
// triangles around every inner vertex turn once. Both are proven on the doubles of the result.
//
// The surface is that of the map: new vertices lie on the flat triangles, and the two sides of an
// edge share them, also along cuts. In the plane there are no T-junctions except where the map is
// cut.
//
// For formats that keep curves, write_vtu() loses nothing.
#pragma once

#include <array>
#include <vector>

#include "majorant/maps/map_file.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

// Overlaps of the result. Excluded: the straight boundary must not meet itself; for injective maps.
enum class Overlap { Allowed, Excluded };

struct TessellationOptions {
  int refine = 1;                      // every cell becomes at least refine x refine triangles
  Overlap overlap = Overlap::Allowed;  // Excluded: for maps that are injective as a whole
};

// A place on a polygon of the input: between three of its corners, with these weights.
struct PlaceOnPolygon {
  std::array<std::size_t, 3> corners;
  Barycentric weights;
};

// The polygon of the input to which a polygon of the result belongs, and the places of its corners.
struct PolygonOrigin {
  Index polygon = 0;
  std::vector<PlaceOnPolygon> corners;
};

// Returns the map as a mesh. input: the mesh from which the map was made, or null. The result has
// its vertices (also unreferenced ones), then new ones, and its polygons in their order, with
// groups, materials, normals and colours. Normals and colours at new vertices are interpolated.
//
// A polygon is kept whole if none of its cells is cut, no cut of the surface crosses it, its image
// is a simple polygon, and programs that cut it otherwise get the same result
// (is_unfolded_cut_from). Otherwise its triangles replace it, in the order of cells. A polygon
// whose cells run backwards around it (the map has its other side up) is written as they run.
// Polygons without cells, of an incomplete map, have no texture coordinates. Without `input` the
// result has the triangles of mesh_from_map in their order.
//
// Texture coordinates: one per corner point of the map in the order of the map's points, then those
// of new vertices. A map of degree 1 with refine = 1 is not changed, positive or not.
//
// Throws Error(Usage) if refine < 1 or the result needs more than 2^31 vertices. Throws
// Error(Invalid) if the map does not belong to `input`, or naming cells for which no such triangles
// are found. origins, if given: one per polygon of the result; none without input.
PolygonMesh tessellate_map(const MapFile& map, const PolygonMesh* input,
                           const TessellationOptions& options = {},
                           std::vector<PolygonOrigin>* origins = nullptr);

// Returns the polygons of the input with more than three corners that the result replaces by
// pieces.
std::vector<Index> split_polygons(const MapFile& map, const PolygonMesh& input,
                                  const TessellationOptions& options = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
