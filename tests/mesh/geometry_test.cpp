// Lengths and angles in space at any scale; a surface made of its parts equals the surface.
#include "majorant/mesh/geometry.h"

#include <gtest/gtest.h>

#include "mesh/test_meshes.h"

namespace majorant {
namespace {

SurfaceMesh scaled_grid(double scale) {
  PolygonMesh mesh = grid(4, bumpy);
  for (Vector3& p : mesh.positions) p *= scale;
  return SurfaceMesh::from_polygons(mesh);
}

TEST(CornerAngle, TheSameAtAnyScale) {
  const SurfaceMesh usual = scaled_grid(1);
  for (const double scale : {1e-100, 1e-40, 1e40, 1e100}) {
    const SurfaceMesh mesh = scaled_grid(scale);
    for (Index h = 0; h < mesh.half_edge_count(); ++h)
      EXPECT_NEAR(corner_angle(mesh, h).radians(), corner_angle(usual, h).radians(), 1e-13)
          << scale << ", " << h;
  }
}

TEST(CornerAngle, AddsUpAndIsTwiceTheArea) {
  const SurfaceMesh mesh = scaled_grid(3);
  double twice_area = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    double sum = 0;
    for (Index k = 0; k < 3; ++k) sum += corner_angle(mesh, 3 * f + k).radians();
    EXPECT_NEAR(sum, kPi, 1e-14);
    twice_area += corner_angle(mesh, 3 * f).sine;
  }
  EXPECT_NEAR(twice_area, 2 * mesh.area(), 1e-12);
}

TEST(Extent, OfTheLargestSide) {
  Points3 points(3, 3);
  points << 1, 2, 3, 1, -7, 4, 0, 0, 0;
  EXPECT_EQ(extent(points), 9);
  EXPECT_EQ(extent(points.topRows(1)), 0);
  EXPECT_EQ(extent(points.topRows(0)), 0);
}

TEST(SurfaceMesh, PartsMakeItAgain) {
  SurfaceParts parts;
  parts.file = "inline.obj";
  parts.origin = {1, 2, 4};
  parts.positions.resize(4, 3);
  parts.positions << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
  parts.faces.resize(2, 3);
  parts.faces << 0, 1, 2, 0, 2, 3;
  parts.input_vertex = {7, 5, 6, 9};
  parts.input_face = {3, 1};
  parts.corner_texcoords = CornerPoints::Random(2, 6);
  parts.texcoord_ids.resize(2, 3);
  parts.texcoord_ids << 0, 1, 2, 0, 2, 4;
  parts.rest_triangles = {{1, {Vector2(0, 0), Vector2(1, 0), Vector2(0, 1)}}};
  const SurfaceParts again = SurfaceMesh::from_parts(parts).parts();
  EXPECT_EQ(again.file, parts.file);
  EXPECT_EQ(again.origin, parts.origin);
  EXPECT_EQ(again.positions, parts.positions);
  EXPECT_EQ(again.faces, parts.faces);
  EXPECT_EQ(again.input_vertex, parts.input_vertex);
  EXPECT_EQ(again.input_face, parts.input_face);
  EXPECT_EQ(again.corner_texcoords, parts.corner_texcoords);
  EXPECT_EQ(again.texcoord_ids, parts.texcoord_ids);
  ASSERT_EQ(again.rest_triangles.size(), 1u);
  EXPECT_EQ(again.rest_triangles[0].face, 1);
  EXPECT_EQ(again.rest_triangles[0].corners, parts.rest_triangles[0].corners);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
