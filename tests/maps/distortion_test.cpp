#include "majorant/maps/distortion.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>

#include "random.h"
#include "singular_values.h"

namespace majorant {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Distortion, IsOneAtIsometries) {
  const PointDistortion d = distortion_of(Eigen::Matrix2d::Identity());
  for (const double value : {d.sigma_1, d.sigma_2, d.area(), d.angle(), d.stretch_l2(),
                             d.stretch_linf(), PointDistortion().stretch_l2()})
    EXPECT_EQ(value, 1);
}

TEST(Distortion, OfAStretchedSquare) {
  Eigen::Matrix2d J;
  J << 0, -4, 0.5, 0;  // diag(1/2, 4), then a quarter turn
  const PointDistortion d = distortion_of(J);
  EXPECT_DOUBLE_EQ(d.sigma_1, 4);
  EXPECT_DOUBLE_EQ(d.sigma_2, 0.5);
  EXPECT_DOUBLE_EQ(d.area(), 2);
  EXPECT_DOUBLE_EQ(d.angle(), 8);
  EXPECT_DOUBLE_EQ(d.stretch_l2(), std::sqrt((1.0 / 16 + 4) / 2));
  EXPECT_DOUBLE_EQ(d.stretch_linf(), 2);
}

TEST(Distortion, AgreesWithSingularValues) {
  test::Random random(5);
  for (int trial = 0; trial < 100; ++trial) {
    Eigen::Matrix2d J;
    for (double& entry : J.reshaped()) entry = random.uniform();
    const Vector2 sigma = test::singular_values(J);
    const PointDistortion d = distortion_of(J);
    EXPECT_NEAR(d.sigma_1, sigma[0], 1e-14);
    EXPECT_NEAR(d.sigma_2, std::copysign(sigma[1], J.determinant()), 1e-14);
    EXPECT_NEAR(d.area(), J.determinant(), 1e-14);
    if (d.sigma_2 <= 0) continue;
    // The stretch of [SSGH01] is that of the inverse map.
    EXPECT_NEAR(d.stretch_l2(), J.inverse().norm() * std::sqrt(0.5), 1e-12 * d.stretch_l2());
  }
}

TEST(Distortion, IsInfiniteWhereNothingIsLeftOrTurnedOver) {
  Eigen::Matrix2d J;
  J << 2, 0, 0, 0;
  EXPECT_EQ(distortion_of(J).area(), 0);
  for (const double last : {0.0, -1.0}) {
    J(1, 1) = last;
    const PointDistortion d = distortion_of(J);
    EXPECT_EQ(d.angle(), kInfinity);
    EXPECT_EQ(d.stretch_l2(), kInfinity);
    EXPECT_EQ(d.stretch_linf(), kInfinity);
  }
  EXPECT_DOUBLE_EQ(distortion_of(J).area(), -2);
  EXPECT_DOUBLE_EQ(distortion_of(J).sigma_2, -1);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
