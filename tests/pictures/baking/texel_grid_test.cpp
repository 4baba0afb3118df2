// Compares the texels that triangles cover, and their coverage, with exact rational arithmetic.
#include "majorant/pictures/baking/texel_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "rational.h"

namespace majorant {
namespace {

using test::Rational;
using RationalPoint = std::array<Rational, 2>;

// Returns twice the area of the part of a triangle in a box, clipped in exact arithmetic.
Rational exact_area(const std::array<Vector2, 3>& corner, const Box2& box) {
  std::vector<RationalPoint> polygon;
  for (const Vector2& p : corner) polygon.push_back({Rational(p.x()), Rational(p.y())});
  for (int side = 0; side < 4; ++side) {
    const std::size_t axis = side % 2;
    const Rational bound(side < 2 ? box.low[static_cast<Index>(axis)]
                                  : box.high[static_cast<Index>(axis)]);
    const auto inside = [&](const RationalPoint& p) -> Rational {
      return side < 2 ? Rational(p[axis] - bound) : Rational(bound - p[axis]);
    };
    std::vector<RationalPoint> kept;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const RationalPoint &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
      const Rational at_p = inside(p), at_q = inside(q);
      if (at_p >= 0) kept.push_back(p);
      if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) {
        const Rational t = at_p / (at_p - at_q);
        kept.push_back({Rational(p[0] + t * (q[0] - p[0])), Rational(p[1] + t * (q[1] - p[1]))});
      }
    }
    polygon = kept;
  }
  Rational area = 0;
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    const RationalPoint &o = polygon[0], &a = polygon[k], &b = polygon[k + 1];
    area += (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
  }
  return area < 0 ? Rational(-area) : area;
}

TEST(TexelGrid, CoverageIsThatOfExactClipping) {
  const TexelGrid grid(8, 4);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  int meeting = 0, thin = 0;
  for (int k = 0; k < 1500; ++k) {
    // Corners on the grid, near it, or anywhere; every third triangle is thinner than any texel.
    const auto coordinate = [&] {
      const double x = uniform(random);
      return k % 2 == 0 ? std::round(x * 16) / 16 : x;
    };
    const Vector2 a(coordinate(), coordinate()), b(coordinate(), coordinate());
    Vector2 c(coordinate(), coordinate());
    if (k % 3 == 0) c = (a + b) / 2 + Vector2(1e-17, 1e-16);
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 8; ++x) {
        const Box2 box = grid.box(x, y);
        const Rational area = exact_area({a, b, c}, box);
        ASSERT_EQ(interiors_meet({a, b, c}, box), area > 0) << k << ' ' << x << ' ' << y;
        if (!(area > 0)) continue;
        ++meeting;
        thin += area < 1e-12;
        const ClippedTriangle part = clipped({a, b, c}, box);
        EXPECT_NEAR(2 * part.area, static_cast<double>(area), 1e-15);
        EXPECT_GE(part.centroid.minCoeff(), 0);
        EXPECT_NEAR(part.centroid.sum(), 1, 1e-14);
        const Vector2 at = part.centroid[0] * a + part.centroid[1] * b + part.centroid[2] * c;
        EXPECT_TRUE((at.array() >= box.low.array() - 1e-12).all() &&
                    (at.array() <= box.high.array() + 1e-12).all());
      }
  }
  EXPECT_GT(meeting, 1000);
  EXPECT_GT(thin, 20);
}

TEST(TexelGrid, CentersAreAtHalf) {
  const TexelGrid grid(4, 2);
  EXPECT_EQ(grid.center(0, 0), Vector2(0.125, 0.75));
  EXPECT_EQ(grid.center(3, 1), Vector2(0.875, 0.25));
  EXPECT_EQ(grid.row(0.75), 0);
  EXPECT_EQ(grid.row(0.25), 1);
  EXPECT_EQ(grid.column(2), 3);
  EXPECT_EQ(grid.column(-1), 0);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
