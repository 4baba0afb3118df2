// First roots of quadratics and cubics: the polynomial is positive before them.
#include "majorant/elements/internal/step_polynomial.h"

#include <gtest/gtest.h>

#include "exact_polynomials.h"
#include "support.h"

namespace majorant {
namespace {

using test::Random;
using test::Rational;
using Cubic = StepPolynomial<3>;

// Returns a (t - r1) (t - r2) (t - r3) with p(0) > 0.
Cubic with_roots(double a, double r1, double r2, double r3) {
  return {{-a * r1 * r2 * r3, a * (r1 * r2 + r1 * r3 + r2 * r3), -a * (r1 + r2 + r3), a}};
}

double at(const Cubic& p, double t) {
  return p.power[0] + t * (p.power[1] + t * (p.power[2] + t * p.power[3]));
}

TEST(Cubics, KnownRoots) {
  EXPECT_NEAR(first_root(with_roots(-1, 1, 2, 3), 10), 1, 1e-14);
  EXPECT_NEAR(first_root(with_roots(-1, 1, 2, 3), 1.5), 1, 1e-14);
  EXPECT_EQ(first_root(with_roots(-1, 1, 2, 3), 0.9), 0.9);
  EXPECT_NEAR(first_root(with_roots(1, -1, 2, 7), 100), 2, 1e-13);
  EXPECT_EQ(first_root(with_roots(-1, -1, -2, 5), 4), 4);
  EXPECT_NEAR(first_root({{1, 0, 0, -1}}, 50), 1, 1e-14);  // a triple root of its derivative
  EXPECT_NEAR(first_root({{1, -2, 0, 0}}, 3), 0.5, 1e-15);
  EXPECT_NEAR(first_root({{6, -5, 1, 0}}, 10), 2, 1e-14);
  EXPECT_EQ(first_root({{1, 1, 1, 1}}, 10), 10);
  EXPECT_EQ(first_root({{1, -1, 1, 0}}, 10), 10);  // no real root
}

TEST(Cubics, ExtremeScales) {
  EXPECT_NEAR(first_root({{1e-30, -1, 1, 1}}, 10) / 1e-30, 1, 1e-12);
  EXPECT_NEAR(first_root({{1e-18, 1, -1, 0}}, 10), 1, 1e-13);
  EXPECT_NEAR(first_root({{1, 0, 0, -1e-60}}, 1e30) / 1e20, 1, 1e-13);
  EXPECT_NEAR(first_root({{1e-200, -1e-200, 0, 0}}, 10), 1, 1e-13);
}

// Squares of the coefficients overflow or underflow.
TEST(Quadratics, ExtremeScales) {
  for (const double scale : {0x1p-1000, 0x1p-560, 0x1p-480, 1.0, 0x1p480, 0x1p560, 0x1p1000}) {
    const auto root = [&](double a, double b, double c, double s) {
      return first_root(StepPolynomial<2>{{a * scale, b * scale, c * scale}}, s);
    };
    EXPECT_DOUBLE_EQ(root(1, -2, 0, 3), 0.5) << scale;
    EXPECT_DOUBLE_EQ(root(6, -5, 1, 10), 2) << scale;
    EXPECT_DOUBLE_EQ(root(6, 5, -1, 10), 6) << scale;
    EXPECT_EQ(root(1, -1, 1, 10), 10) << scale;
  }
  EXPECT_NEAR(first_root(StepPolynomial<2>{{1, 1e200, -1e300}}, 1) / 1e-100, 1, 1e-12);
  EXPECT_EQ(first_root(StepPolynomial<2>{{1, -std::numeric_limits<double>::infinity(), 1}}, 1), 0);
}

// Rounding may hide a double root, but not a sign change.
TEST(Cubics, NearlyDoubleRoots) {
  Cubic p = with_roots(-1, 1, 1, 3);
  p.power[0] -= 1e-12;
  EXPECT_NEAR(first_root(p, 10), 1 - std::sqrt(0.5e-12), 1e-9);
  p.power[0] += 2e-12;  // raised above 0: the first root is near 3
  EXPECT_NEAR(first_root(p, 10), 3, 1e-8);
}

TEST(Cubics, NonfiniteCoefficientsAllowNoStep) {
  for (int k = 0; k < 4; ++k)
    for (const double bad : {std::nan(""), -std::numeric_limits<double>::infinity()}) {
      Cubic p{{1, 0, 0, 0}};
      p.power[k] = bad;
      EXPECT_EQ(first_root(p, 1), 0) << k;
    }
}

TEST(Cubics, RandomCubicsArePositiveOnlyBeforeTheirRoot) {
  Random random(1);
  int found = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    Cubic p{{random.uniform(0, 1), random.uniform(-5, 5), random.uniform(-5, 5),
             random.uniform(-5, 5)}};
    const double root = first_root(p, 1);
    for (int k = 0; k < 50; ++k) ASSERT_GT(at(p, root * k / 50), -1e-15);
    if (root == 1) continue;
    ++found;
    ASSERT_LE(std::abs(at(p, root)), 1e-14);
  }
  EXPECT_GT(found, 5000);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
