// Compares second-order forward differentiation with closed forms and differences.
#include "majorant/framework/dual2.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "random.h"

namespace majorant {
namespace {

using D = Dual2<double, 2>;

void expect_dual(const D& f, double v, Vector2 g, double xx, double xy, double yy) {
  const double tol =
      1e-14 * (1 + std::abs(v) + g.norm() + std::abs(xx) + std::abs(xy) + std::abs(yy));
  EXPECT_NEAR(f.v, v, tol);
  EXPECT_NEAR(f.d[0], g[0], tol);
  EXPECT_NEAR(f.d[1], g[1], tol);
  EXPECT_NEAR(f.hess(0, 0), xx, tol);
  EXPECT_NEAR(f.hess(0, 1), xy, tol);
  EXPECT_EQ(f.hess(0, 1), f.hess(1, 0));
  EXPECT_NEAR(f.hess(1, 1), yy, tol);
}

TEST(Dual2, Operations) {
  test::Random random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const double p = random.uniform(0.2, 2), q = random.uniform(0.2, 2);
    const auto [x, y] = dual2_variables<double>(p, q);
    expect_dual(x * y, p * q, {q, p}, 0, 1, 0);
    expect_dual(x / y, p / q, {1 / q, -p / (q * q)}, 0, -1 / (q * q), 2 * p / (q * q * q));
    expect_dual(2.0 / x, 2 / p, {-2 / (p * p), 0}, 4 / (p * p * p), 0, 0);
    expect_dual(x / 2.0, p / 2, {0.5, 0}, 0, 0, 0);
    expect_dual(1.0 - x, 1 - p, {-1, 0}, 0, 0, 0);
    expect_dual(x - 1.0 + y, p - 1 + q, {1, 1}, 0, 0, 0);
    expect_dual(1.0 + x - y, 1 + p - q, {1, -1}, 0, 0, 0);
    expect_dual(-x * 3.0, -3 * p, {-3, 0}, 0, 0, 0);
    const double r = std::sqrt(p * q);
    expect_dual(sqrt(x * y), r, {r / (2 * p), r / (2 * q)}, -r / (4 * p * p), r / (4 * p * q),
                -r / (4 * q * q));
    expect_dual(log(x * y), std::log(p * q), {1 / p, 1 / q}, -1 / (p * p), 0, -1 / (q * q));
    const double e = std::exp(p * q);
    expect_dual(exp(x * y), e, {q * e, p * e}, q * q * e, (1 + p * q) * e, p * p * e);
  }
}

// A function of (x, y), for doubles and for duals, and its smooth domain.
struct Smooth {
  const char* name;
  std::function<double(double, double)> f;
  std::function<D(const D&, const D&)> dual;
};
template <class F>
Smooth smooth(const char* name, F f) {
  return {name, f, f};
}

std::vector<Smooth> smooth_functions() {
  using std::abs, std::acos, std::asin, std::atan, std::atan2, std::cos, std::cosh, std::exp;
  using std::hypot, std::log, std::max, std::min, std::pow, std::sin, std::sinh, std::sqrt;
  using std::tan, std::tanh;
  return {
      smooth("sqrt", [](auto x, auto y) { return sqrt(x * y + 0.5); }),
      smooth("log", [](auto x, auto y) { return log(x * x + y); }),
      smooth("exp", [](auto x, auto y) { return exp(x - x * y); }),
      smooth("pow(x, c)", [](auto x, auto y) { return pow(x * y, -1.7) + pow(x - y - 5.0, 3.0); }),
      smooth("pow(c, x)", [](auto x, auto y) { return pow(1.7, x * y) * pow(0.3, y); }),
      smooth("pow(x, y)", [](auto x, auto y) { return pow(x, y - x * y); }),
      smooth("sin", [](auto x, auto y) { return sin(x + x * y); }),
      smooth("cos", [](auto x, auto y) { return cos(x - y * y); }),
      smooth("tan", [](auto x, auto y) { return tan(0.6 * x * y - 0.4); }),
      smooth("asin", [](auto x, auto y) { return asin(0.2 * x * y - 0.1); }),
      smooth("acos", [](auto x, auto y) { return acos(0.2 * x - 0.3 * y); }),
      smooth("atan", [](auto x, auto y) { return atan(x * y - 2.0 * y); }),
      smooth("atan2", [](auto x, auto y) { return atan2(x - 1.0, y * x - 2.5); }),
      smooth("atan2(c, x)", [](auto x, auto y) { return atan2(1.0, x * y) + atan2(y * x, -2.0); }),
      smooth("sinh", [](auto x, auto y) { return sinh(x - y * x); }),
      smooth("cosh", [](auto x, auto y) { return cosh(x * y - 1.0); }),
      smooth("tanh", [](auto x, auto y) { return tanh(x - 2.0 * y * x); }),
      smooth("hypot", [](auto x, auto y) { return hypot(x - y * y, x) + hypot(3.0, x * y); }),
      smooth("abs", [](auto x, auto y) { return abs(x * y + 0.1) + abs(-x - y * x); }),
      smooth("min", [](auto x, auto y) { return min(x * y, x * y + 1.0) - min(9.0, x * x); }),
      smooth("max", [](auto x, auto y) { return max(x * y, x * y - 1.0) - max(-9.0, x * x); }),
      smooth("assignments",
             [](auto x, auto y) {
               auto z = x;
               z *= y;
               z -= x * y * y;
               z += y * x;
               z /= x + 1.0;
               z *= 2.0;
               z -= 1.0;
               z /= 3.0;
               z += 0.5;
               return z - (+y) - -x * 1.5;
             }),
  };
}

TEST(Dual2, FunctionsAgainstDifferences) {
  test::Random random(2);
  const double h = 1e-5;
  for (const Smooth& s : smooth_functions()) {
    SCOPED_TRACE(s.name);
    for (int trial = 0; trial < 20; ++trial) {
      const double p = random.uniform(0.3, 1.6), q = random.uniform(0.3, 1.6);
      const auto at = [&s](double a, double b) {
        const auto [x, y] = dual2_variables<double>(a, b);
        return s.dual(x, y);
      };
      const D f = at(p, q);
      EXPECT_NEAR(f.v, s.f(p, q), 1e-14 * (1 + std::abs(f.v)));
      const D xs[] = {at(p - h, q), at(p + h, q)}, ys[] = {at(p, q - h), at(p, q + h)};
      const double tol = 1e-7 * (1 + std::abs(f.v) + std::abs(f.h[0]) + std::abs(f.h[2]));
      EXPECT_NEAR(f.d[0], (xs[1].v - xs[0].v) / (2 * h), tol);
      EXPECT_NEAR(f.d[1], (ys[1].v - ys[0].v) / (2 * h), tol);
      EXPECT_NEAR(f.hess(0, 0), (xs[1].d[0] - xs[0].d[0]) / (2 * h), tol);
      EXPECT_NEAR(f.hess(1, 0), (xs[1].d[1] - xs[0].d[1]) / (2 * h), tol);
      EXPECT_NEAR(f.hess(1, 1), (ys[1].d[1] - ys[0].d[1]) / (2 * h), tol);
    }
  }
}

TEST(Dual2, Kinks) {
  const auto at = [](double a, double b) { return dual2_variables<double>(a, b); };
  const auto [x, y] = at(0, 0);
  expect_dual(abs(x), 0, {1, 0}, 0, 0, 0);
  expect_dual(abs(x * x - y), 0, {0, -1}, 2, 0, 0);
  expect_dual(min(x, y), 0, {1, 0}, 0, 0, 0);
  expect_dual(max(x, y), 0, {1, 0}, 0, 0, 0);
  expect_dual(max(x, 0), 0, {1, 0}, 0, 0, 0);
  expect_dual(max(0, x), 0, {0, 0}, 0, 0, 0);
  expect_dual(hypot(x, y), 0, {0, 0}, 0, 0, 0);
  const auto [u, w] = at(1e200, 1e200);
  EXPECT_DOUBLE_EQ(hypot(u, w).v, std::sqrt(2) * 1e200);
  EXPECT_FALSE(std::isfinite(sqrt(x).d[0]));
  EXPECT_FALSE(std::isfinite(atan2(x, y).d[0]));
  EXPECT_FALSE(std::isfinite(asin(1.0 - x).d[0]));
  EXPECT_EQ(asin(0.5 * u / u + x).v, std::asin(0.5));
}

TEST(Dual2, PowersOfZeroAndOfNegatives) {
  const auto [x, y] = dual2_variables<double>(0, -3);
  expect_dual(pow(x, 0), 1, {0, 0}, 0, 0, 0);
  expect_dual(pow(x, 1), 0, {1, 0}, 0, 0, 0);
  expect_dual(pow(x, 2), 0, {0, 0}, 2, 0, 0);
  expect_dual(pow(x, 3), 0, {0, 0}, 0, 0, 0);
  expect_dual(pow(y, 3), -27, {0, 27}, 0, 0, -18);
  expect_dual(pow(y, -1), -1.0 / 3, {0, -1.0 / 9}, 0, 0, -2.0 / 27);
  expect_dual(pow(0.0, 2.0 + x), 0, {0, 0}, 0, 0, 0);
  EXPECT_FALSE(std::isfinite(pow(x, 0.5).d[0]));
  EXPECT_TRUE(std::isnan(pow(y, 0.5).v));
}

TEST(Dual2, Comparisons) {
  const auto [x, y] = dual2_variables<double>(1, 2);
  EXPECT_TRUE(x < y && y > x && x <= y && y >= x && x != y && x + 1.0 == y);
  EXPECT_TRUE(x < 2 && x <= 1 && x == 1 && x != 2 && y > 1 && y >= 2);
  EXPECT_TRUE(2 > x && 1 >= x && 1 == x && 2 != x && 1 < y && 2 <= y);
  const D nan = x * std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(nan < x || nan > x || nan == nan || nan <= 0 || nan >= 0);
  EXPECT_TRUE(nan != nan);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
