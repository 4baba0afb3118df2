#include "majorant/mesh/exact_predicates.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "certify/exact_curves.h"
#include "majorant/framework/rounding.h"

namespace majorant {
namespace {

using exact::Rational;

int exact_sign(const Vector2& a, const Vector2& b, const Vector2& c) {
  const auto minus = [](double x, double y) { return Rational(x) - Rational(y); };
  const Rational area =
      minus(b.x(), a.x()) * minus(c.y(), a.y()) - minus(b.y(), a.y()) * minus(c.x(), a.x());
  return area.sign();
}

// Points that are collinear up to last digits, at sizes where products underflow and overflow.
TEST(ExactPredicates, OrientationOfPointsCloseToALine) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int wrong_in_doubles = 0, signs[3] = {};
  for (const double scale : {1.0, 1e-170, 1e-300, 1e160})
    for (int k = 0; k < 2000; ++k) {
      const Vector2 a(uniform(random), uniform(random)), b(uniform(random), uniform(random));
      Vector2 c = a + uniform(random) * (b - a);
      if (k % 2 == 0) c.x() = std::nextafter(c.x(), uniform(random) > 0 ? 2 : -2);
      if (k % 5 == 0) c = (a + 3 * b) / 4;
      const Vector2 p = scale * a, q = scale * b, r = scale * c;
      const int sign = exact_sign(p, q, r);
      EXPECT_EQ(orientation(p, q, r), sign);
      EXPECT_EQ(orientation(q, p, r), -sign);
      const double plain = (q - p).x() * (r - p).y() - (q - p).y() * (r - p).x();
      wrong_in_doubles += (plain > 0) - (plain < 0) != sign;
      ++signs[sign + 1];
    }
  EXPECT_GT(wrong_in_doubles, 100);  // the cases are difficult
  for (const int count : signs) EXPECT_GT(count, 10);
}

int exact_circle_sign(const Vector2& a, const Vector2& b, const Vector2& c, const Vector2& d) {
  Rational x[3], y[3];
  const Vector2* corners[3] = {&a, &b, &c};
  for (int k = 0; k < 3; ++k) {
    x[k] = Rational(corners[k]->x()) - Rational(d.x());
    y[k] = Rational(corners[k]->y()) - Rational(d.y());
  }
  Rational value = 0;
  for (int k = 0; k < 3; ++k) {
    const int l = (k + 1) % 3, m = (k + 2) % 3;
    value += (x[k] * x[k] + y[k] * y[k]) * (x[l] * y[m] - y[l] * x[m]);
  }
  return value.sign();
}

// Points that are cocircular up to last digits, some with integer coordinates, at sizes where
// products underflow and overflow.
TEST(ExactPredicates, PointsCloseToACircle) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int signs[3] = {};
  for (const double scale : {1.0, 1e-60, 1e-90, 1e-170, 1e-300, 1e90, 1e160})
    for (int k = 0; k < 2000; ++k) {
      Vector2 p[4];
      const Vector2 centre(uniform(random), uniform(random));
      for (Vector2& q : p) {
        const double angle = 4 * uniform(random);
        q = centre + Vector2(std::cos(angle), std::sin(angle));
        // (3, 4), (5, 0) and other integer points of a circle; multiples of 1/16 are exact, too.
        if (k % 3 == 0) q = Vector2(3, 4);
        if (k % 3 == 0 && angle > 0) q = Vector2(4, -3);
        if (k % 3 == 0 && angle > 1) q = Vector2(-5, 0);
        if (k % 3 == 0 && angle < -2) q = Vector2(0, 5);
      }
      if (k % 3 == 0 && k % 2 == 0) p[3] *= 1 + 0x1p-20;
      if (k % 5 == 0) p[3] = p[0] + p[2] - p[1];
      for (Vector2& q : p) q *= k % 3 == 0 ? power_of_two(scale) : scale;
      const int sign = exact_circle_sign(p[0], p[1], p[2], p[3]);
      ASSERT_EQ(in_circle(p[0], p[1], p[2], p[3]), sign) << scale << " " << k;
      ASSERT_EQ(in_circle(p[1], p[0], p[2], p[3]), -sign) << scale << " " << k;
      ++signs[sign + 1];
    }
  for (const int count : signs) EXPECT_GT(count, 100);
}

TEST(ExactPredicates, Segments) {
  EXPECT_TRUE(segments_meet({0, 0}, {2, 2}, {0, 2}, {2, 0}));
  EXPECT_TRUE(segments_meet({0, 0}, {2, 2}, {1, 1}, {5, 0}));                      // end inside
  EXPECT_TRUE(segments_meet({0, 0}, {2, 2}, {2, 2}, {3, 9}));                      // common end
  EXPECT_FALSE(segments_meet({0, 0}, {2, 2}, {std::nextafter(1, 2), 1}, {5, 0}));  // disjoint
  EXPECT_TRUE(segments_meet({0, 0}, {2, 2}, {1, 1}, {3, 3}));                      // collinear
  EXPECT_FALSE(segments_meet({0, 0}, {2, 2}, {3, 3}, {4, 4}));
  EXPECT_FALSE(segments_meet({0, 0}, {1, 0}, {0.5, 1}, {0.5, 5e-324}));
  EXPECT_TRUE(segments_fold({0, 0}, {2, 2}, {1, 1}));
  EXPECT_TRUE(segments_fold({0, 0}, {0, 2}, {0, 1}));
  EXPECT_FALSE(segments_fold({0, 0}, {2, 2}, {3, 3}));
  EXPECT_FALSE(segments_fold({0, 0}, {2, 2}, {1, std::nextafter(1, 2)}));
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
