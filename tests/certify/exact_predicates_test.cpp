#include "majorant/mesh/exact_predicates.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "certify/exact_curves.h"

namespace majorant {
namespace {

using exact::Rational;

int exact_sign(const Vector2& a, const Vector2& b, const Vector2& c) {
  const auto minus = [](double x, double y) { return Rational(x) - Rational(y); };
  const Rational area =
      minus(b.x(), a.x()) * minus(c.y(), a.y()) - minus(b.y(), a.y()) * minus(c.x(), a.x());
  return area.sign();
}

// Points on a line up to some last digits, at sizes where products underflow and overflow.
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
  EXPECT_GT(wrong_in_doubles, 100);  // the cases are hard
  for (const int count : signs) EXPECT_GT(count, 10);
}

TEST(ExactPredicates, Segments) {
  EXPECT_TRUE(segments_meet({0, 0}, {2, 2}, {0, 2}, {2, 0}));
  EXPECT_TRUE(segments_meet({0, 0}, {2, 2}, {1, 1}, {5, 0}));                      // end inside
  EXPECT_TRUE(segments_meet({0, 0}, {2, 2}, {2, 2}, {3, 9}));                      // common end
  EXPECT_FALSE(segments_meet({0, 0}, {2, 2}, {std::nextafter(1, 2), 1}, {5, 0}));  // beside
  EXPECT_TRUE(segments_meet({0, 0}, {2, 2}, {1, 1}, {3, 3}));                      // one line
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
