// Small generated meshes.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "majorant/framework/types.h"
#include "majorant/mesh/polygon_mesh.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

inline constexpr double kPi = 3.14159265358979323846;

// Face k (0-based) is from line 101 + k of "inline.obj".
inline PolygonMesh polygon_mesh(std::vector<Vector3> positions, IndexLists polygons) {
  PolygonMesh mesh;
  mesh.file = "inline.obj";
  mesh.positions = std::move(positions);
  mesh.polygons = std::move(polygons);
  for (std::size_t k = 0; k < mesh.polygons.size(); ++k)
    mesh.polygon_lines.push_back(101 + static_cast<long>(k));
  return mesh;
}

using Height = std::function<double(double, double)>;
inline double flat(double, double) { return 0; }
inline double bumpy(double x, double y) { return 0.4 * std::sin(2.5 * x + 0.3) * std::cos(2 * y); }

// Returns (n+1)^2 vertices row by row over the unit square and 2 n^2 triangles.
inline PolygonMesh grid(int n, const Height& height = flat) {
  std::vector<Vector3> positions;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double x = double(i) / n, y = double(j) / n;
      positions.push_back({x, y, height(x, y)});
    }
  std::vector<std::vector<Index>> faces;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const Index a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      faces.push_back({a, b, d});
      faces.push_back({a, d, c});
    }
  return polygon_mesh(std::move(positions), std::move(faces));
}

// Returns a torus of m by n quads, each divided into two triangles, without its first `holes`
// quads.
inline PolygonMesh torus(int m, int n, int holes) {
  std::vector<Vector3> positions;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < m; ++i) {
      const double s = 2 * kPi * i / m, t = 2 * kPi * j / n, r = 2 + std::cos(t);
      positions.push_back({r * std::cos(s), r * std::sin(s), std::sin(t)});
    }
  std::vector<std::vector<Index>> faces;
  for (int q = holes; q < m * n; ++q) {
    const int i = q % m, j = q / m, i1 = (i + 1) % m, j1 = (j + 1) % n;
    faces.push_back({j * m + i, j * m + i1, j1 * m + i1});
    faces.push_back({j * m + i, j1 * m + i1, j1 * m + i});
  }
  return polygon_mesh(std::move(positions), std::move(faces));
}

// Returns a fan of `count` triangles around vertex 0, the apex of a cone; if closed, the last
// triangle is adjacent to the first.
inline PolygonMesh cone(int count, bool closed) {
  std::vector<Vector3> positions{{0, 0, 1}};
  const int rim = closed ? count : count + 1;
  for (int k = 0; k < rim; ++k) {
    const double t = 2 * kPi * k / (closed ? count : count + 2);
    positions.push_back({std::cos(t), std::sin(t), 0});
  }
  std::vector<std::vector<Index>> faces;
  for (int k = 0; k < count; ++k) faces.push_back({0, 1 + k, 1 + (k + 1) % rim});
  return polygon_mesh(std::move(positions), std::move(faces));
}

inline std::shared_ptr<const SurfaceMesh> surface(const PolygonMesh& mesh) {
  return std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(mesh));
}

// Returns uv per vertex by a function of the position.
inline Vec uv_of(const SurfaceMesh& mesh, const std::function<Vector2(const Vector3&)>& map) {
  Vec uv(2 * mesh.vertex_count());
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    uv.segment<2>(2 * v) = map(mesh.positions().row(v).transpose());
  return uv;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
