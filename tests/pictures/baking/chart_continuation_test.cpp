// Points beyond the edges of faces: on flat surfaces those of the plane, across cuts; around
// folds, at borders, and at edges of three faces.
#include "majorant/pictures/baking/chart_continuation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mesh/test_meshes.h"

namespace majorant {
namespace {

// Cuts the mesh along x = 1/2.
SurfaceMesh halves(const SurfaceMesh& mesh) {
  std::vector<char> is_cut(mesh.opposites().size(), 0);
  const auto is_middle = [&](Index v) { return mesh.positions()(v, 0) == 0.5; };
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    is_cut[to_size(h)] = is_middle(mesh.from_vertex(h)) && is_middle(mesh.to_vertex(h));
  return mesh.cut_along(is_cut, nullptr);
}

Vector3 point(const SurfaceMesh& mesh, const SurfacePlace& place) {
  Vector3 p = Vector3::Zero();
  for (Index k = 0; k < 3; ++k)
    p += place.barycentric[k] * mesh.positions().row(mesh.faces()(place.face, k)).transpose();
  return p;
}

TEST(ChartContinuation, GoesStraightOnFlatGroundAcrossCuts) {
  const SurfaceMesh mesh = halves(*surface(grid(8)));
  ASSERT_EQ(face_components(mesh.opposites()).back(), 1);
  const ChartContinuation continuation(mesh);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-2, 2);
  int across = 0;
  for (int k = 0; k < 3000; ++k) {
    SurfacePlace place{std::uniform_int_distribution<Index>(0, mesh.face_count() - 1)(random), {}};
    place.barycentric << uniform(random), uniform(random), 0;
    place.barycentric[2] = 1 - place.barycentric[0] - place.barycentric[1];
    const SurfacePlace found = continuation.at(place);
    EXPECT_GE(found.barycentric.minCoeff(), 0);
    EXPECT_NEAR(found.barycentric.sum(), 1, 1e-12);
    const Vector3 required = point(mesh, place);
    const bool is_inside =
        required.x() > 0 && required.x() < 1 && required.y() > 0 && required.y() < 1;
    if (!is_inside) continue;
    EXPECT_LE((point(mesh, found) - required).norm(), 1e-12);
    const double from = point(mesh, {place.face, Barycentric::Constant(1.0 / 3)}).x();
    across += (from < 0.5) != (required.x() < 0.5);
  }
  EXPECT_GT(across, 100);
}

TEST(ChartContinuation, BendsWithTheSurfaceAndEndsAtItsBorder) {
  // A step: flat up to x = 1, then vertical, then the border.
  const auto mesh =
      surface(polygon_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0, 1}, {1, 1, 1}},
                           {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}}));
  const ChartContinuation continuation(*mesh);
  // a point of the plane of the first face: corners 0, 1, 2
  const auto beyond = [&](double x, double y) {
    return point(*mesh, continuation.at({0, Barycentric(1 - x, x - y, y)}));
  };
  EXPECT_LE((beyond(1.25, 0.5) - Vector3(1, 0.5, 0.25)).norm(), 1e-15);
  EXPECT_LE((beyond(1.5, 0.25) - Vector3(1, 0.25, 0.5)).norm(), 1e-15);
  EXPECT_LE((beyond(0.5, 0.75) - Vector3(0.5, 0.75, 0)).norm(), 1e-15);
  EXPECT_LE((beyond(0.5, -0.5) - Vector3(0.5, 0, 0)).norm(), 1e-15);
  EXPECT_LE((beyond(2.5, 0.5) - Vector3(1, 0.5, 1)).norm(), 1e-15);
}

TEST(ChartContinuation, EndsAtEdgesOfThreeFaces) {
  // Three triangles at one edge without common vertices: their vertices have equal positions.
  std::vector<Vector3> positions;
  std::vector<std::vector<Index>> faces;
  for (const Vector3& tip : {Vector3(1, 0, 0), Vector3(-1, 0, 0), Vector3(0, 1, 0)}) {
    const auto first = static_cast<Index>(positions.size());
    positions.insert(positions.end(), {Vector3(0, 0, 0), Vector3(0, 0, 1), tip});
    faces.push_back({first, first + 1, first + 2});
  }
  const auto mesh = std::make_shared<const SurfaceMesh>(
      SurfaceMesh::from_polygons(polygon_mesh(positions, faces), {}, Components::Any));
  const ChartContinuation continuation(*mesh);
  for (Index f = 0; f < 3; ++f) {
    const SurfacePlace found = continuation.at({f, Barycentric(0.75, 0.5, -0.25)});
    EXPECT_EQ(found.face, f);
    EXPECT_EQ(found.barycentric[2], 0);
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
