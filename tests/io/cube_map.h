// A closed surface with charts and cones, for tests of cut maps.
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "majorant/mesh/polygon_mesh.h"
#include "majorant/parametrization/initialization/start.h"

namespace majorant {

// Returns a cube of 2 x 2 quads per side, as triangles; each side is a chart, rotated by s * 90
// degrees.
inline PolygonMesh cube() {
  PolygonMesh mesh;
  mesh.file = "cube";
  const auto vertex = [&](const Vector3& p) {
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
      if (mesh.positions[v] == p) return static_cast<Index>(v);
    mesh.positions.push_back(p);
    return static_cast<Index>(mesh.positions.size() - 1);
  };
  for (int s = 0; s < 6; ++s) {
    const Vector3 normal = (s < 3 ? 1 : -1) * Vector3::Unit(s % 3);
    const Vector3 e = Vector3::Unit((s + 1) % 3), f = normal.cross(e);
    const auto base = static_cast<Index>(mesh.texcoords.size());
    std::vector<Index> corners;
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        corners.push_back(vertex(normal + (i - 1) * e + (j - 1) * f));
        mesh.texcoords.push_back(rotated(Vector2(i - 1, j - 1), s) + Vector2(3 * s, 0.25 * s));
      }
    for (const int a : {0, 1, 3, 4})
      for (const auto& t : {std::array{a, a + 1, a + 4}, std::array{a, a + 4, a + 3}}) {
        const auto corner = [&](std::size_t k) { return corners[static_cast<std::size_t>(t[k])]; };
        mesh.polygons.push_back({corner(0), corner(1), corner(2)});
        mesh.polygon_texcoords.push_back({base + t[0], base + t[1], base + t[2]});
      }
  }
  return mesh;
}

inline BezierMap cube_map(int degree) {
  BezierMap map = seamless_from_texture(SurfaceMesh::from_polygons(cube())).map;
  while (map.degree() < degree) map = map.elevated();
  return map;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
