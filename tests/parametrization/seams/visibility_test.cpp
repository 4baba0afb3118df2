// Visibility of known shapes, and of cuts.
#include "majorant/parametrization/seams/visibility.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "majorant/framework/parallel.h"
#include "majorant/mesh/repair.h"
#include "majorant/parametrization/seams/choose_cuts.h"
#include "mesh/obj_file.h"
#include "parametrization/seams/cut_checks.h"
#include "public_data.h"

namespace majorant {
namespace {

// Returns a square plate with a wall around a part of it.
SurfaceMesh pit(int n) {
  return SurfaceMesh::from_polygons(grid(n, [](double x, double y) {
    const bool is_low = x > 0.3 && x < 0.7 && y > 0.3 && y < 0.7;
    return is_low ? -0.6 : 0.0;
  }));
}

TEST(Visibility, OfConvexSurfacesIsComplete) {
  const Vec seen = ambient_visibility(SurfaceMesh::from_polygons(cube_sphere(6)));
  EXPECT_GT(seen.minCoeff(), 1 - 1e-12);
}

TEST(Visibility, IsLessInAPit) {
  const SurfaceMesh mesh = pit(20);
  const Vec seen = ambient_visibility(mesh);
  double low = 0, count = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.positions()(v, 2) < -0.5) low += seen[v], ++count;
  EXPECT_LT(low / count, 0.5);
  EXPECT_GT(seen.maxCoeff(), 0.95);
  const ThreadCount two(2);
  EXPECT_EQ(ambient_visibility(mesh), seen);
}

// A triangle close to a plate and facing it. None of its vertices has a number from which rays
// start.
TEST(Visibility, OfEveryComponent) {
  PolygonMesh mesh = grid(114);
  const auto first = static_cast<Index>(mesh.positions.size());
  for (const Vector3& p :
       {Vector3(0.45, 0.45, 0.05), Vector3(0.45, 0.55, 0.05), Vector3(0.55, 0.45, 0.05)})
    mesh.positions.push_back(p);
  mesh.polygons.push_back({first, first + 1, first + 2});
  mesh.polygon_lines.clear();
  const Vec seen = ambient_visibility(*repair(mesh).mesh);
  EXPECT_LT(seen.tail<3>().maxCoeff(), 0.1);
}

// A plate high above a part of another one.
TEST(Visibility, FromADirectionBehindOtherParts) {
  PolygonMesh mesh = grid(10);
  const auto first = static_cast<Index>(mesh.positions.size());
  for (const auto& [x, y] : {std::pair(0.25, 0.25), {0.75, 0.25}, {0.75, 0.75}, {0.25, 0.75}})
    mesh.positions.emplace_back(x, y, 0.5);
  mesh.polygons.push_back({first, first + 1, first + 2, first + 3});
  mesh.polygon_lines.clear();
  const SurfaceMesh surface = *repair(mesh).mesh;
  const Vec above = visibility_from(surface, {0, 0, 1});
  for (Index v = 0; v < surface.vertex_count(); ++v) {
    const Vector3 p = surface.positions().row(v);
    const bool is_hidden =
        p.z() == 0 && std::abs(p.x() - 0.5) < 0.25 && std::abs(p.y() - 0.5) < 0.25;
    EXPECT_EQ(above[v], is_hidden ? 0 : 1) << p.transpose();
  }
  EXPECT_EQ(visibility_from(surface, {0, 0, -1}).maxCoeff(), 0);
}

TEST(Visibility, FromADirection) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(cube_sphere(6));
  const Vec seen = visibility_from(mesh, {0, 0, 3});
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const double z = mesh.positions()(v, 2) / mesh.positions().row(v).norm();
    EXPECT_NEAR(seen[v], std::max(0.0, z), 0.1);
  }
  CutOptions options;
  options.preferences.weight = hiding_weights(mesh, seen);
  const double hidden = visibility_of_cuts(mesh, seen, choose_cuts(mesh, options).is_cut);
  EXPECT_LT(hidden, 0.05);
}

// Returns visibility 1 except in a valley along half a circle; it is lowest on the circle.
Vec seen_outside_of_a_valley(const SurfaceMesh& mesh, double width) {
  Vec seen(mesh.vertex_count());
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Vector3 p = mesh.positions().row(v).transpose().normalized();
    const double across = std::asin(p.y()), along = std::acos(std::clamp(p.x(), -1.0, 1.0));
    seen[v] = std::min(1.0, (std::abs(across) + 0.1 * along) / width + (p.z() < 0 ? 1 : 0));
  }
  return seen;
}

TEST(Visibility, CutsRunThroughHollows) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(cube_sphere(8));
  const Vec seen = seen_outside_of_a_valley(mesh, 0.3);
  CutOptions options;
  options.preferences.weight = hiding_weights(mesh, seen);
  // 0.84 if cuts pass only the vertices where they reduce the strain most.
  EXPECT_LT(visibility_of_cuts(mesh, seen, choose_cuts(mesh, options).is_cut), 0.8);
}

// At most 0.7 of the visibility without weights, with cuts of at most 1.15 times the length.
TEST(Visibility, SeamsOfAPenguinAreHidden) {
  const std::filesystem::path folder = public_data("closed");
  if (folder.empty()) GTEST_SKIP() << kNoPublicData;
  const RepairedSurface surface = repair(obj_file(folder / "penguin_6720.obj"));
  const SurfaceMesh& mesh = *surface.mesh;
  const Vec seen = ambient_visibility(mesh);
  CutOptions options;
  const SurfaceCuts any = choose_cuts(mesh, options);
  options.preferences.weight = hiding_weights(mesh, seen);
  const SurfaceCuts hidden = choose_cuts(mesh, options);
  EXPECT_LE(hidden.length, 1.15 * any.length);
  EXPECT_LE(visibility_of_cuts(mesh, seen, hidden.is_cut),
            0.7 * visibility_of_cuts(mesh, seen, any.is_cut));
}

TEST(Visibility, DoesNotDependOnTheScale) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(limbs(4));
  PolygonMesh input;  // triangles, since diagonals of quads may depend on the size
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    input.positions.push_back(mesh.positions().row(v));
  for (Index f = 0; f < mesh.face_count(); ++f)
    input.polygons.push_back({mesh.faces()(f, 0), mesh.faces()(f, 1), mesh.faces()(f, 2)});
  const Vec seen = ambient_visibility(mesh);
  for (const double scale : {0x1p-300, 0x1p300}) {
    const auto scaled =
        transformed(input, [scale](const Vector3& p) -> Vector3 { return scale * p; });
    EXPECT_LT((ambient_visibility(SurfaceMesh::from_polygons(scaled)) - seen).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
