// Rest shapes of maps: the bits of flat triangles, and rest triangles where the mesh has them.
#include "majorant/maps/rest_shapes_of.h"

#include <gtest/gtest.h>

#include <cmath>

#include "majorant/maps/bezier_map.h"
#include "majorant/mesh/repair.h"
#include "mesh/test_meshes.h"

namespace majorant {
namespace {

TEST(RestShapesOf, AreFlatTrianglesBitForBit) {
  const auto mesh = surface(grid(5, bumpy));
  for (const double scale : {1.0, 0.37, 1e6}) {
    const RestShapes rest = rest_shapes(*mesh, scale);
    const RestShapes flat = flat_triangles(mesh->positions() * scale, mesh->faces());
    EXPECT_EQ(rest.inverse, flat.inverse);
    EXPECT_EQ(rest.measure, flat.measure);
  }
  for (const Index f : {0, 7})
    EXPECT_EQ(rest_shape(*mesh, f).inverse.row(0), rest_shapes(*mesh).inverse.row(f));
}

TEST(RestShapesOf, FacesWithoutAreaHaveTheirRestTriangles) {
  PolygonMesh flat_face = grid(4, bumpy);
  flat_face.positions[12] = flat_face.positions[13];
  const RepairedSurface out = repair(flat_face);
  const SurfaceMesh& mesh = *out.mesh;
  ASSERT_EQ(mesh.rest_triangles().size(), 2u);
  const double scale = 0.5;
  const RestShapes rest = rest_shapes(mesh, scale);
  const RestShapes flat = flat_triangles(mesh.positions() * scale, mesh.faces());
  EXPECT_TRUE(rest.inverse.allFinite());
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const bool is_regular =
        f != mesh.rest_triangles()[0].face && f != mesh.rest_triangles()[1].face;
    if (is_regular) {
      EXPECT_EQ(rest.inverse.row(f), flat.inverse.row(f));
      continue;
    }
    double longest = 0;
    for (Index h = 3 * f; h < 3 * f + 3; ++h) longest = std::max(longest, mesh.edge_length(h));
    EXPECT_NEAR(rest.measure[f] / (scale * scale * longest * longest), kNeedleHeight / 2, 1e-18);
  }
  EXPECT_NEAR(rest.measure.sum() / (scale * scale), mesh.area(), 1e-12);
}

// The map onto the rest triangle has the singular values 1.
TEST(RestShapesOf, JacobiansAreThoseFromTheRestTriangle) {
  const RepairedSurface out =
      repair(polygon_mesh({{0, 0, 0}, {2, 0, 0}, {0.5, 0, 0}}, {{0, 1, 2}}));
  ASSERT_EQ(out.mesh->rest_triangles().size(), 1u);
  Vec uv(6);
  for (Index k = 0; k < 3; ++k) uv.segment<2>(2 * k) = out.mesh->rest_triangles()[0].corners[k];
  const auto [sigma_max, sigma_min] =
      BezierMap::linear(out.mesh, uv).singular_values(0, {1 / 3., 1 / 3., 1 / 3.});
  EXPECT_NEAR(sigma_max, 1, 1e-9);
  EXPECT_NEAR(sigma_min, 1, 1e-9);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
