// Sector angles around vertices: double covers and overlapping boundaries.
#include <gtest/gtest.h>

#include <numbers>

#include "majorant/constraints/local_injectivity.h"
#include "support.h"

namespace majorant {
namespace {

using std::numbers::pi;

// A fan of `count` triangles around vertex 0; vertices 1.. are on a circle, with `turns` windings.
struct Fan {
  Fan(int count, double turns, bool closed, int degree) {
    const int rim = closed ? count : count + 1;
    faces.resize(count, 3);
    uv.resize(rim + 1, 2);
    uv.row(0).setZero();
    for (int k = 0; k < rim; ++k) {
      const double t = 2 * pi * turns * k / count;
      uv.row(k + 1) << std::cos(t), std::sin(t);
    }
    for (int k = 0; k < count; ++k) faces.row(k) << 0, 1 + k, 1 + (k + 1) % rim;
    space = std::make_shared<const BezierTriangleSpace>(faces, rim + 1, degree);
    x = test::linear_map(*space, uv);
  }
  Cells faces;
  Points2 uv;
  std::shared_ptr<const BezierTriangleSpace> space;
  Vec x;
};

class Angles : public testing::TestWithParam<int> {};

TEST_P(Angles, InjectiveMapsSumToFullTurnsInside) {
  const test::Mesh mesh = test::grid(4, 4, 0.25);
  const auto space = std::make_shared<const BezierTriangleSpace>(mesh.faces, 25, GetParam());
  test::Random random(1);
  Vec x = test::linear_map(*space, test::flat(mesh.positions));
  x += 0.05 / GetParam() * random.vector(x.size());
  ASSERT_TRUE(LocalInjectivity(space, test::rest_determinants(mesh)).check(x).feasible);
  const Vec sums = vertex_angle_sums(*space, x);
  ASSERT_EQ(sums.size(), 25);
  for (int j = 1; j < 4; ++j)
    for (int i = 1; i < 4; ++i) EXPECT_NEAR(sums[5 * j + i], 2 * pi, 1e-13);
  EXPECT_TRUE(AngleSums(space, AngleSums::Vertices::Interior).check(x).feasible);
  EXPECT_TRUE(AngleSums(space, AngleSums::Vertices::Boundary).check(x).feasible);
  // Before the perturbation, angle sums are 180 degrees on straight sides and 90 degrees at
  // corners.
  const Vec flat = vertex_angle_sums(*space, test::linear_map(*space, test::flat(mesh.positions)));
  EXPECT_NEAR(flat[2], pi, 1e-13);
  EXPECT_NEAR(flat[0], pi / 2, 1e-13);
}

// Products of tangents of these sizes underflow or overflow.
TEST_P(Angles, DoNotDependOnTheScale) {
  const Fan fan(7, 1, true, GetParam());
  const Vec sums = vertex_angle_sums(*fan.space, fan.x);
  for (const double size : {0x1p-800, 0x1p-400, 0x1p400, 0x1p800})
    EXPECT_EQ(vertex_angle_sums(*fan.space, size * fan.x), sums) << size;
}

// All determinants are positive, but the map covers the disk twice.
TEST_P(Angles, DoubleCoversAreRefused) {
  const Fan fan(7, 2, true, GetParam());
  EXPECT_TRUE(LocalInjectivity(fan.space, Vec::Ones(7)).check(fan.x).feasible);
  EXPECT_NEAR(vertex_angle_sums(*fan.space, fan.x)[0], 4 * pi, 1e-12);
  const Verdict v = AngleSums(fan.space, AngleSums::Vertices::Interior).check(fan.x);
  EXPECT_FALSE(v.feasible);
  EXPECT_EQ(v.blocking, std::vector<Index>{0});
  EXPECT_LT(v.margin, 0);
  EXPECT_TRUE(AngleSums(fan.space, AngleSums::Vertices::Boundary).check(fan.x).feasible);

  const Fan single(7, 1, true, GetParam());
  EXPECT_TRUE(AngleSums(single.space, AngleSums::Vertices::Interior).check(single.x).feasible);
}

TEST_P(Angles, BoundaryVerticesMayNotPassAFullTurn) {
  const AngleSums::Vertices boundary = AngleSums::Vertices::Boundary;
  for (const double turns : {0.3, 0.99, 1.01, 1.5}) {
    const Fan fan(8, turns, false, GetParam());
    EXPECT_TRUE(LocalInjectivity(fan.space, Vec::Ones(8)).check(fan.x).feasible);
    EXPECT_NEAR(vertex_angle_sums(*fan.space, fan.x)[0], 2 * pi * turns, 1e-12);
    const Verdict v = AngleSums(fan.space, boundary).check(fan.x);
    EXPECT_EQ(v.feasible, turns < 1);
    EXPECT_EQ(v.blocking, turns > 1 ? std::vector<Index>{0} : std::vector<Index>{});
    EXPECT_TRUE(AngleSums(fan.space, AngleSums::Vertices::Interior).check(fan.x).feasible);
  }
}

TEST_P(Angles, NaNIsInfeasible) {
  Fan fan(7, 1, true, GetParam());
  fan.x[0] = std::nan("");
  EXPECT_FALSE(AngleSums(fan.space, AngleSums::Vertices::Interior).check(fan.x).feasible);
}

INSTANTIATE_TEST_SUITE_P(Degrees, Angles, testing::Values(1, 2, 3, 5));

// Angles are those of tangents, not of chords (method.md N4): one edge of a quadratic corner is
// curved.
TEST(AngleSums, AreMeasuredBetweenTangents) {
  Cells face(1, 3);
  face << 0, 1, 2;
  const BezierTriangleSpace space(face, 3, 2);
  Points2 corners(3, 2);
  corners << 0, 0, 1, 0, 0, 1;
  Vec x = test::linear_map(space, corners);
  EXPECT_NEAR(vertex_angle_sums(space, x)[0], pi / 2, 1e-15);
  x.segment<2>(2 * space.cells()(0, 3)) = Vector2(0.5, -0.5);  // edge 01 begins at -45 degrees
  const Vec sums = vertex_angle_sums(space, x);
  EXPECT_NEAR(sums[0], 0.75 * pi, 1e-15);
  EXPECT_NEAR(sums[1], 0.5 * pi, 1e-15);  // between (-1, -1) and (-1, 1)
  EXPECT_NEAR(sums[2], 0.25 * pi, 1e-15);
}

TEST(AngleSums, DoNotRestrictSteps) {
  const Fan fan(5, 1, true, 1);
  const StepBound b =
      AngleSums(fan.space, AngleSums::Vertices::Interior).max_step(fan.x, fan.x, 0.7);
  EXPECT_EQ(b.step, 0.7);
  EXPECT_TRUE(b.blocking.empty());
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
