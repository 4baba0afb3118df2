// Distortion of whole maps against exact values of affine maps and sums over many points.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>

#include "majorant/elements/quadrature.h"
#include "majorant/framework/parallel.h"
#include "majorant/maps/distortion.h"
#include "maps/test_maps.h"
#include "mesh/test_meshes.h"

namespace majorant {
namespace {

// Returns (x, y) -> (4 x, y / 2), rotated.
BezierMap stretched(const PolygonMesh& mesh, int degree) {
  const auto flat_mesh = surface(mesh);
  const Eigen::Rotation2Dd turn(0.3);
  const Vec uv = uv_of(
      *flat_mesh, [&](const Vector3& p) { return Vector2(turn * Vector2(4 * p.x(), p.y() / 2)); });
  return elevated_to(BezierMap::linear(flat_mesh, uv), degree);
}

void expect_spread(const Spread& spread, double value) {
  EXPECT_NEAR(spread.mean, value, 1e-13 * value);
  for (const double p : spread.percentile) EXPECT_NEAR(p, value, 1e-13 * value);
}

TEST(MeasureDistortion, AffineMapsAreExact) {
  for (const int degree : {1, 2, 3, 8}) {
    const MapDistortion measured = measure_distortion(stretched(grid(3), degree));
    Eigen::Matrix<double, 1, 6> expected;
    expected << 4, 0.5, 2, 8, std::sqrt((1.0 / 16 + 4) / 2), 2;
    for (Index f = 0; f < measured.faces.rows(); ++f)
      EXPECT_LT((measured.faces.row(f) - expected).norm(), 1e-12) << measured.faces.row(f);
    const DistortionSummary all = summary(measured);
    expect_spread(all.sigma_1, 4);
    expect_spread(all.sigma_2, 0.5);
    expect_spread(all.area, 2);
    expect_spread(all.angle, 8);
    EXPECT_NEAR(all.stretch_l2, expected[4], 1e-13);
    EXPECT_NEAR(all.stretch_linf, 2, 1e-12);
    const DistortionSummary half = summary(measure_distortion(stretched(grid(3), degree), 0.5));
    expect_spread(half.sigma_1, 2);
    expect_spread(half.angle, 8);
    EXPECT_NEAR(half.stretch_linf, 4, 1e-12);
  }
}

BezierMap bent(int degree) {
  const auto mesh = surface(grid(4, bumpy));
  const Vec uv = uv_of(*mesh, [](const Vector3& p) { return Vector2(p.x() + p.z(), p.y()); });
  return shaken(elevated_to(BezierMap::linear(mesh, uv), degree), 0.004, 3);
}

TEST(MeasureDistortion, CurvedMapsAgreeWithManyPoints) {
  const Quadrature rule = composite_rule(radon_rule(), 24);
  for (const int degree : {2, 3, 5}) {
    const BezierMap map = bent(degree);
    const MapDistortion measured = measure_distortion(map);
    double square = 0, total = 0;
    for (Index f = 0; f < map.mesh().face_count(); ++f) {
      Eigen::Matrix<double, 1, 6> sum = Eigen::Matrix<double, 1, 6>::Zero();
      for (Index l = 0; l < rule.size(); ++l) {
        const PointDistortion d =
            distortion_of(map.jacobian(f, Barycentric(rule.points.row(l).transpose())));
        ASSERT_GT(d.sigma_2, 0);
        const double l2 = d.stretch_l2(), w = rule.weights[l];
        sum.head<5>() +=
            w * Eigen::Matrix<double, 1, 5>(d.sigma_1, d.sigma_2, d.area(), d.angle(), l2 * l2);
        sum[5] = std::max(sum[5], d.stretch_linf());
      }
      square += measured.area[f] * sum[4];
      total += measured.area[f];
      sum[4] = std::sqrt(sum[4]);
      for (int k = 0; k < 5; ++k) EXPECT_NEAR(measured.faces(f, k) / sum[k], 1, 5e-4) << k;
      EXPECT_NEAR(measured.faces(f, 5) / sum[5], 1, 0.05);
      EXPECT_GE(measured.faces(f, 5), measured.faces(f, 4));
    }
    EXPECT_NEAR(summary(measured).stretch_l2, std::sqrt(square / total), 1e-4);
  }
}

TEST(MeasureDistortion, PercentilesAreByArea) {
  MapDistortion a, b;
  a.faces = FaceDistortion::Ones(2, 6);
  a.area = Vector2(1, 3);
  a.samples = {{{5, 5}, 1}, {{2, 2}, 3}};
  b.faces = FaceDistortion::Ones(1, 6);
  b.area = Vec::Constant(1, 96);
  b.samples = {{{3, 3}, 95}, {{0, -1}, 1}};
  const auto expected = std::array<double, 7>{0, 3, 3, 3, 3, 3, 3};
  EXPECT_EQ(summary({&a, &b}).sigma_1.percentile, expected);  // 0: 1 %, 2: 4 %, 3: 99 %, 5: 100 %
  EXPECT_EQ(summary({&b, &a}).sigma_1.percentile, expected);
  const auto alone = std::array<double, 7>{2, 2, 2, 2, 2, 5, 5};
  EXPECT_EQ(summary(a).sigma_2.percentile, alone);  // 2: 75 %
  EXPECT_EQ(summary(b).sigma_2.percentile[0], -1);  // inverted: below all other values
  EXPECT_EQ(summary(b).angle.percentile[5], 1);     // infinite above 99 %
  EXPECT_EQ(summary(b).area.percentile[0], 0);
}

TEST(MeasureDistortion, FacesTurnedOverAreInfinitelyStretched) {
  const auto mesh = surface(grid(2));
  Vec uv = uv_of(*mesh, [](const Vector3& p) { return Vector2(p.head<2>()); });
  const Index middle = 4;
  uv.segment<2>(2 * middle) << 5, 5;
  for (const int degree : {1, 2}) {
    const MapDistortion measured =
        measure_distortion(elevated_to(BezierMap::linear(mesh, uv), degree));
    Index turned = 0;
    for (Index f = 0; f < measured.faces.rows(); ++f) {
      if (measured.faces(f, 2) > 0) continue;
      ++turned;
      for (const Index k : {3, 4, 5})
        EXPECT_EQ(measured.faces(f, k), std::numeric_limits<double>::infinity());
      EXPECT_LT(measured.faces(f, 1), 0);
    }
    EXPECT_GT(turned, 0);
    EXPECT_EQ(summary(measured).stretch_l2, std::numeric_limits<double>::infinity());
    EXPECT_NEAR(summary(measured).area.mean, 1, 1e-12);  // the boundary is fixed
  }
}

TEST(MeasureDistortion, FacesWithoutAnAreaDoNotCount) {
  const BezierMap map = stretched(grid(1), 2);
  RestShapes rest = flat_triangles(map.mesh().positions(), map.mesh().faces());
  rest.measure[0] = 1e-300;
  rest.inverse.row(0).setConstant(std::numeric_limits<double>::infinity());
  const MapDistortion measured =
      measure_distortion(2, map.space().cells(), map.control_points(), rest, 1);
  EXPECT_TRUE(std::isnan(measured.faces(0, 0)));
  expect_spread(summary(measured).sigma_1, 4);
  EXPECT_NEAR(summary(measured).stretch_linf, 2, 1e-13);
}

TEST(MeasureDistortion, ThreadsDoNotMatter) {
  const BezierMap map = elevated_to(stretched(grid(12, bumpy), 1), 3);
  const ThreadCount one(1);
  const MapDistortion expected = measure_distortion(map);
  const ThreadCount three(3);
  EXPECT_EQ(measure_distortion(map).faces, expected.faces);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
