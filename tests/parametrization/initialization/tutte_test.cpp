// Tutte's start satisfies its definition (method.md N7).
#include <set>

#include "expected_error.h"
#include "majorant/parametrization/initialization/filled_holes.h"
#include "majorant/parametrization/initialization/start.h"
#include "mesh/obj_file.h"
#include "mesh/test_meshes.h"

namespace majorant {
namespace {

Vector2 uv_at(const Vec& uv, Index v) { return uv.segment<2>(2 * v); }

double image_area(const SurfaceMesh& mesh, const Vec& uv, Index f) {
  const Vector2 a = uv_at(uv, mesh.faces()(f, 0)), b = uv_at(uv, mesh.faces()(f, 1)),
                c = uv_at(uv, mesh.faces()(f, 2));
  return 0.5 * ((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x());
}

void expect_tutte(const SurfaceMesh& mesh) {
  const Vec uv = tutte_map(mesh);
  ASSERT_EQ(uv.size(), 2 * mesh.vertex_count());
  const double radius = std::sqrt(mesh.area() / kPi);
  const std::vector<Index>& loop = mesh.boundary_loops().front();
  EXPECT_NEAR(uv_at(uv, loop[0]).x(), radius, 1e-14 * radius);
  EXPECT_EQ(uv_at(uv, loop[0]).y(), 0);

  // The angle of a boundary vertex is proportional to the arc length of the loop.
  double length = 0, arc = 0;
  for (std::size_t k = 0; k < loop.size(); ++k)
    length +=
        (mesh.positions().row(loop[(k + 1) % loop.size()]) - mesh.positions().row(loop[k])).norm();
  std::set<Index> boundary(loop.begin(), loop.end());
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const double angle = 2 * kPi * arc / length;
    const Vector2 expected = radius * Vector2(std::cos(angle), std::sin(angle));
    EXPECT_LT((uv_at(uv, loop[k]) - expected).norm(), 1e-12 * radius) << "vertex " << loop[k];
    arc +=
        (mesh.positions().row(loop[(k + 1) % loop.size()]) - mesh.positions().row(loop[k])).norm();
  }

  std::vector<std::set<Index>> neighbours(to_size(mesh.vertex_count()));
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l)
        if (k != l) neighbours[mesh.faces()(f, k)].insert(mesh.faces()(f, l));
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (boundary.count(v)) continue;
    Vector2 mean = Vector2::Zero();
    for (const Index w : neighbours[v]) mean += uv_at(uv, w);
    mean /= static_cast<double>(neighbours[v].size());
    EXPECT_LT((uv_at(uv, v) - mean).norm(), 1e-12 * radius) << "vertex " << v;
  }
  for (Index f = 0; f < mesh.face_count(); ++f)
    EXPECT_GT(image_area(mesh, uv, f), 0) << "face " << f;
}

TEST(TutteMap, SatisfiesItsDefinition) {
  for (const char* name : {"cap", "creature", "ribbon", "tube", "wavy_disk"}) {
    SCOPED_TRACE(name);
    expect_tutte(*generated(name));
  }
  expect_tutte(*surface(cone(7, true)));
}

// Faces of the opposite orientation have a map that is positive on them.
TEST(TutteMap, FollowsTheOrientationOfTheFaces) {
  PolygonMesh mesh = grid(4, bumpy);
  for (const auto polygon : mesh.polygons) std::swap(polygon[0], polygon[2]);
  // All vertices of a square's corner triangles are on the boundary, but no triangle is degenerate.
  const auto reversed = surface(mesh);
  const Vec uv = tutte_map(*reversed);
  for (Index f = 0; f < reversed->face_count(); ++f) EXPECT_GT(image_area(*reversed, uv, f), 0);
}

TEST(TutteMap, WithoutInteriorVertices) {
  expect_tutte(*surface(polygon_mesh({{0, 0, 0}, {3, 0, 0}, {0, 4, 1}}, {{0, 1, 2}})));
  expect_tutte(*surface(grid(1, bumpy)));
  expect_tutte(*surface(cone(5, false)));
}

// The boundary vertex that comes first in the file, not in the stored loop, is at angle 0.
TEST(TutteMap, StartsAtTheFirstBoundaryVertex) {
  PolygonMesh mesh = cone(6, true);  // vertex 0 is interior
  const auto fan = surface(mesh);
  const Vec uv = tutte_map(*fan);
  EXPECT_GT(uv_at(uv, 1).x(), 0);
  EXPECT_EQ(uv_at(uv, 1).y(), 0);
}

TEST(TutteMap, ScalesWithTheMesh) {
  PolygonMesh mesh = grid(5, bumpy);
  const Vec uv = tutte_map(*surface(mesh));
  for (Vector3& p : mesh.positions) p *= 1024;
  EXPECT_LT((tutte_map(*surface(mesh)) - 1024 * uv).norm(), 1e-12 * 1024 * uv.norm());
}

// A band of quads around an axis: one of its two ends is a hole.
TEST(FilledSurface, IsADiskAroundTheSurface) {
  constexpr Index n = 9;
  RowMatrix positions(2 * n, 3);
  Cells faces(2 * n, 3);
  for (Index k = 0; k < n; ++k) {
    const double angle = 2 * kPi * k / n;
    const Index next = (k + 1) % n;
    positions.row(2 * k) << 2 * std::cos(angle), 2 * std::sin(angle), 0;
    positions.row(2 * k + 1) << std::cos(angle), std::sin(angle), 1;
    faces.row(2 * k) << 2 * k, 2 * next, 2 * next + 1;
    faces.row(2 * k + 1) << 2 * k, 2 * next + 1, 2 * k + 1;
  }
  const SurfaceMesh ring = SurfaceMesh::from_arrays(positions, faces);
  const SurfaceMesh filled = filled_surface(ring);
  EXPECT_NO_THROW(filled.require_disk());
  EXPECT_EQ(filled.face_count(), 3 * n);
  EXPECT_EQ(filled.faces().topRows(2 * n), ring.faces());
  ASSERT_EQ(filled.vertex_count(), 2 * n + 1);
  EXPECT_LT((filled.positions().row(2 * n) - Eigen::RowVector3d(0, 0, 1)).norm(), 1e-15);
  EXPECT_EQ(filled.boundary_loops().front().size(), outer_loop(ring).size());
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
