// Triangles by their side lengths; Ptolemaic flips and their reversal.
#include "majorant/parametrization/fields/internal/intrinsic_triangulation.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "parametrization/fields/closed_surfaces.h"

namespace majorant {
namespace {

TEST(TriangleShape, OfKnownTriangles) {
  const TriangleShape right = triangle_shape({std::log(3), std::log(4), std::log(5)});
  EXPECT_FALSE(right.broken);
  EXPECT_NEAR(right.angle[0], std::asin(0.6), 1e-15);
  EXPECT_NEAR(right.angle[1], std::asin(0.8), 1e-15);
  EXPECT_NEAR(right.angle[2], kPi / 2, 1e-15);
  EXPECT_NEAR(right.cotangent[0], 4.0 / 3, 1e-14);
  EXPECT_NEAR(right.cotangent[1], 3.0 / 4, 1e-14);
  EXPECT_NEAR(right.cotangent[2], 0, 1e-14);
  EXPECT_NEAR(std::exp(right.log_area), 6, 1e-13);
  // Sides 1, 1 and 1e-9; the small angle has full relative accuracy.
  const TriangleShape needle = triangle_shape({std::log(1e-9), 0, 0});
  EXPECT_NEAR(needle.angle[0] / 1e-9, 1, 1e-12);
  EXPECT_NEAR(needle.angle[1], kPi / 2, 1e-9);
  EXPECT_NEAR(needle.cotangent[0] * 1e-9, 1, 1e-12);
}

TEST(TriangleShape, BrokenAndExtremeOnesStayFinite) {
  const TriangleShape broken = triangle_shape({0, std::log(3), 0});
  EXPECT_TRUE(broken.broken);
  EXPECT_EQ(broken.angle, (std::array<double, 3>{0, kPi, 0}));
  EXPECT_EQ(broken.cotangent, (std::array<double, 3>{0, 0, 0}));
  // 2 = 1 + 1: the triangle inequality is not strict
  EXPECT_TRUE(triangle_shape({std::log(2), 0, 0}).broken);
  for (const double big : {-800.0, -300.0, 0.0, 300.0, 800.0})
    for (const double small : {-1e4, -800.0, -700.0, -40.0, 0.0}) {
      const TriangleShape shape = triangle_shape({big + small, big, big});
      EXPECT_NEAR(shape.angle[0] + shape.angle[1] + shape.angle[2], kPi, 1e-14);
      for (const double cotangent : shape.cotangent) EXPECT_TRUE(std::isfinite(cotangent));
      EXPECT_FALSE(std::isnan(shape.log_area));
    }
}

Vec sorted(Vec values) {
  std::sort(values.begin(), values.end());
  return values;
}

// Expects opposite half-edges in pairs, in opposite directions and of equal length.
void expect_consistent(const IntrinsicTriangulation& triangulation, const Vec& lengths) {
  const auto from = [&](Index h) { return triangulation.faces()(h / 3, h % 3); };
  const auto to = [&](Index h) { return triangulation.faces()(h / 3, (h + 1) % 3); };
  for (Index h = 0; h < triangulation.half_edge_count(); ++h) {
    const Index o = triangulation.opposite(h);
    if (o < 0) continue;
    ASSERT_NE(o, h);
    ASSERT_EQ(triangulation.opposite(o), h);
    EXPECT_EQ(from(h), to(o));
    EXPECT_EQ(to(h), from(o));
    EXPECT_NEAR(lengths[h], lengths[o], 1e-12);
  }
}

TEST(IntrinsicTriangulation, DelaunayHasNoBrokenTriangles) {
  for (const auto& mesh : {surface(sphere(4)), surface(torus(9, 5, 0))})
    for (const double amount : {0.1, 1.0, 5.0, 10.0}) {
      const Vec u = random_factors(*mesh, amount);
      IntrinsicTriangulation triangulation(*mesh);
      const Index flips = triangulation.make_delaunay(u);
      if (amount > 1) {
        EXPECT_GT(flips, 0);
      }
      EXPECT_FALSE(triangulation.has_broken_triangles(u)) << amount;
      expect_consistent(triangulation, triangulation.log_lengths(u));
      EXPECT_EQ(triangulation.make_delaunay(u), 0);
    }
}

// After other Delaunay triangulations the first one returns with its lengths, since lengths are
// coordinates of the same metric.
TEST(IntrinsicTriangulation, FlipsAreReversible) {
  const auto mesh = surface(torus(9, 5, 0));
  PolygonMesh shaken_input = torus(9, 5, 0);
  const Vec noise = random_factors(*mesh, 0.1);
  for (std::size_t v = 0; v < shaken_input.positions.size(); ++v)
    shaken_input.positions[v] *= std::exp(noise[static_cast<Index>(v)]);  // no cocircular points
  const auto shaken_mesh = surface(shaken_input);
  const Vec zero = Vec::Zero(mesh->vertex_count());
  IntrinsicTriangulation triangulation(*shaken_mesh);
  triangulation.make_delaunay(zero);
  const Vec before = sorted(triangulation.log_lengths(zero));
  EXPECT_GT(triangulation.make_delaunay(random_factors(*mesh, 6)), 100);
  EXPECT_GT((sorted(triangulation.log_lengths(zero)) - before).norm(), 1);
  triangulation.make_delaunay(zero);
  EXPECT_LT((sorted(triangulation.log_lengths(zero)) - before).norm(), 1e-10);
}

// Four points of a circle: the new diagonal has the Euclidean length, and a second flip restores
// the first length.
TEST(IntrinsicTriangulation, FlipOnACircleIsEuclidean) {
  std::vector<Vector3> points;
  for (const double angle : {0.0, 1.0, 2.5, 4.0})
    points.push_back({std::cos(angle), std::sin(angle), 0});
  const auto mesh = surface(polygon_mesh(points, {{0, 1, 2}, {0, 2, 3}}));
  IntrinsicTriangulation triangulation(*mesh);
  // Shorter sides at the ends of the diagonal make it violate the Delaunay condition.
  Vec u(4);
  u << -0.5, 0.5, -0.5, 0.5;
  EXPECT_EQ(triangulation.make_delaunay(-u), 1);
  const Vec lengths = triangulation.log_lengths(Vec::Zero(4));
  for (Index h = 0; h < 6; ++h) {
    const Index a = triangulation.faces()(h / 3, h % 3),
                b = triangulation.faces()(h / 3, (h + 1) % 3);
    EXPECT_NEAR(std::exp(lengths[h]), (points[a] - points[b]).norm(), 1e-14);
  }
  const Points2 vectors = triangulation.surface_vectors(Vec::Zero(4));
  for (Index h = 0; h < 6; ++h)
    EXPECT_NEAR(vectors.row(h).norm(),
                (points[mesh->from_vertex(h)] - points[mesh->to_vertex(h)]).norm(), 1e-14);
}

// Vectors of the surface's triangles have the sum 0 and agree at edges; edges that were not flipped
// keep their lengths.
TEST(IntrinsicTriangulation, SurfaceVectorsFit) {
  const auto mesh = surface(sphere(4));
  const Vec u = random_factors(*mesh, 3);
  IntrinsicTriangulation triangulation(*mesh);
  EXPECT_GT(triangulation.make_delaunay(u), 20);
  const Vec lengths = triangulation.log_lengths(u);
  const Points2 vectors = triangulation.surface_vectors(u);
  double area = 0, flipped_area = 0;
  for (Index f = 0; f < mesh->face_count(); ++f) {
    const auto sides = vectors.middleRows(3 * f, 3);
    EXPECT_LT(sides.colwise().sum().norm(), 1e-12 * sides.norm());
    area += 0.5 * (sides(0, 0) * sides(1, 1) - sides(0, 1) * sides(1, 0));
    flipped_area += std::exp(IntrinsicTriangulation::shape(lengths, f).log_area);
    for (Index h = 3 * f; h < 3 * f + 3; ++h)
      EXPECT_NEAR(vectors.row(h).norm() / vectors.row(mesh->opposite(h)).norm(), 1, 1e-10);
  }
  EXPECT_NEAR(area / flipped_area, 1, 1e-12);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
