// What the tests of parametrization/ share: expected errors, small meshes made on the spot, the
// generated meshes of meshes/.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/io/read_mesh.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/parametrization/maps/bezier_map.h"

namespace majorant {

inline constexpr double kPi = 3.14159265358979323846;

// The message of the Error of that kind that `action` throws; fails the test if there is none.
inline std::string error_message(ErrorKind kind, const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(static_cast<int>(error.kind()), static_cast<int>(kind)) << error.what();
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message;
  }
  ADD_FAILURE() << "no error";
  return {};
}

inline void expect_contains(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in: " << text;
}

// Face k (0-based) comes from line 101 + k of "inline.obj".
inline PolygonMesh polygon_mesh(std::vector<Vector3> positions,
                                std::vector<std::vector<Index>> polygons) {
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

// (n+1)^2 vertices row by row over the unit square, 2 n^2 triangles.
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

// A torus of m by n quads, each split in two; without its first `holes` quads.
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

// A fan of `count` triangles around vertex 0, spread over `angle` radians on a cone of that angle;
// closed when count triangles go all the way round.
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

// A mesh of meshes/, all of them disks.
inline std::shared_ptr<const SurfaceMesh> generated(const std::string& name) {
  return surface(read_mesh(std::string(MAJORANT_SOURCE_DIR) + "/meshes/" + name + ".obj"));
}

// uv per vertex by a function of the position.
inline Vec uv_of(const SurfaceMesh& mesh, const std::function<Vector2(const Vector3&)>& map) {
  Vec uv(2 * mesh.vertex_count());
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    uv.segment<2>(2 * v) = map(mesh.positions().row(v).transpose());
  return uv;
}

inline BezierMap elevated_to(BezierMap map, int degree) {
  while (map.degree() < degree) map = map.elevated();
  return map;
}

// A map of that degree with its control points moved at random by up to `amount`.
inline BezierMap shaken(const BezierMap& map, double amount, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-amount, amount);
  Vec x = map.control_points();
  for (double& value : x) value += uniform(random);
  return BezierMap(map.shared_mesh(), map.shared_space(), std::move(x));
}

inline Barycentric random_point(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  double a = uniform(random), b = uniform(random);
  if (a + b > 1) a = 1 - a, b = 1 - b;
  return {a, b, 1 - a - b};
}

}  // namespace majorant
