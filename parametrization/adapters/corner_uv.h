// Texture coordinates per polygon corner, from the map of the surface that was made from the
// polygons.
//
//   const PolygonMesh polygons = read_mesh(path);  // or filled from any mesh data structure
//   const auto mesh = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(polygons));
//   const ParametrizationResult result = parametrize(mesh, {});
//   const std::vector<std::vector<Vector2>> uv = corner_uv(polygons, *result.map);
//
// The adapters of this folder (cgal.h, eigen.h, openmesh.h) do all of this for their mesh data
// structures. For maps of triangles, BezierMap::corner_uv() suffices.
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/maps/bezier_map.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

// Returns u, v of every corner, parallel to polygons.polygons. Values are NaN in polygons that the
// map does not cover, as a chart of an atlas does. Throws InvalidArgument if the map belongs to
// another mesh. Throws Error(Unsupported) if a seam runs across a polygon, so that one corner has
// two values; triangulate such a mesh beforehand.
inline std::vector<std::vector<Vector2>> corner_uv(const PolygonMesh& polygons,
                                                   const BezierMap& map) {
  const Vector2 none = Vector2::Constant(std::numeric_limits<double>::quiet_NaN());
  std::vector<std::vector<Vector2>> out;
  for (const auto polygon : polygons.polygons) out.emplace_back(polygon.size(), none);
  const SurfaceMesh& mesh = map.mesh();
  const Points2 uv = map.corner_uv();
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Index p = mesh.input_face(h / 3), v = mesh.input_vertex(mesh.from_vertex(h));
    const auto refuse = [&](const char* what) {
      return "face " + std::to_string(p) + ", vertex " + std::to_string(v) + ": " + what;
    };
    if (to_size(p) >= out.size())
      throw InvalidArgument(refuse("the map is of another mesh, there is no such face"));
    const std::span<const Index> polygon = polygons.polygons[p];
    const auto corner = std::find(polygon.begin(), polygon.end(), v);
    if (corner == polygon.end())
      throw InvalidArgument(refuse("the map is of another mesh, the face lacks this vertex"));
    Vector2& place = out[p][static_cast<std::size_t>(corner - polygon.begin())];
    const Vector2 here = uv.row(h);
    if (place.allFinite() && place != here)
      throw Error(ErrorKind::Unsupported,
                  refuse("a seam runs across the polygon; triangulate the mesh beforehand"));
    place = here;
  }
  return out;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
