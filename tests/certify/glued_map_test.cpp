#include "majorant/certify/internal/glued_map.h"

#include <gtest/gtest.h>

#include "majorant/mesh/repair.h"

namespace majorant {
namespace {

// Returns two adjacent squares with separate vertices in space and in the plane, where the second
// one is moved to the right.
BezierMap two_squares(double moved, int degree) {
  PolygonMesh mesh;
  for (const double left : {0.0, 1.0})
    for (const double y : {0.0, 1.0})
      for (const double x : {0.0, 1.0}) mesh.positions.emplace_back(left + x, y, 0);
  mesh.polygons = {{0, 1, 3}, {0, 3, 2}, {4, 5, 7}, {4, 7, 6}};
  const std::shared_ptr<const SurfaceMesh> surface = repair(mesh).mesh;
  Vec uv(2 * surface->vertex_count());
  for (Index v = 0; v < surface->vertex_count(); ++v)
    uv.segment<2>(2 * v) =
        surface->positions().row(v).head<2>().transpose() + Vector2(v < 4 ? 0 : moved, 0);
  BezierMap map = BezierMap::linear(surface, uv);
  while (map.degree() < degree) map = map.elevated();
  return map;
}

TEST(GluedMap, HasNoBoundaryWhereTheMapIsContinuous) {
  for (const int degree : {1, 2, 3}) {
    const BezierMap map = two_squares(0, degree);
    EXPECT_EQ(map.mesh().topology().components, 2);
    const std::optional<BezierMap> one = glued(map);
    ASSERT_TRUE(one);
    EXPECT_EQ(one->mesh().topology().components, 1);
    EXPECT_EQ(one->mesh().topology().boundary_loops, 1);
    EXPECT_EQ(one->mesh().vertex_count(), 6);
    EXPECT_EQ(one->degree(), degree);
    for (Index f = 0; f < 4; ++f)
      for (const Barycentric& xi : {Barycentric(1, 0, 0), Barycentric(0.2, 0.3, 0.5)})
        EXPECT_EQ(one->evaluate(f, xi), map.evaluate(f, xi));
  }
}

TEST(GluedMap, DoesNotExistForSeparatePieces) { EXPECT_FALSE(glued(two_squares(0.5, 1))); }

TEST(GluedMap, DoesNotExistWhereSideCurvesDiffer) {
  const BezierMap map = two_squares(0, 2);
  Vec x = map.control_points();
  Index moved = 0;
  for (Index k = 0; k < x.size() && moved == 0; k += 2)
    if (Vector2(x.segment<2>(k)) == Vector2(1, 0.5)) x[k] += 0.01, ++moved;
  ASSERT_EQ(moved, 1);
  EXPECT_FALSE(glued(map.with(map.shared_space(), x)));
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
