// Second-order forward differentiation, several numbers at a time.
#include <gtest/gtest.h>

#include <xsimd/xsimd.hpp>

#include "majorant/framework/dual2.h"

namespace majorant {
namespace {

using B = xsimd::batch<double>;

void expect_same(const Dual2<B, 2>& b, const Dual2<double, 2>& s) {
  const auto lane = B::size - 1;
  const auto close = [](double x, double y) { EXPECT_NEAR(x, y, 1e-14 * (1 + std::abs(y))); };
  close(b.v.get(0), s.v);
  for (std::size_t k = 0; k < 2; ++k) close(b.d[k].get(lane), s.d[k]);
  for (std::size_t k = 0; k < 3; ++k) close(b.h[k].get(0), s.h[k]);
}

TEST(Dual2Batches, AgreeWithDoubles) {
  const auto agree = [](auto f, double p, double q) {
    const auto [x, y] = dual2_variables<double>(p, q);
    const auto [bx, by] = dual2_variables<B>(B(p), B(q));
    expect_same(f(bx, by), f(x, y));
  };
  const auto all = [&](double p, double q) {
    agree([](auto x,
             auto y) { return sqrt(x * x + y) / (1.0 + x) - 2.0 * log(y) + exp(x - y) * 0.5; },
          p, q);
    agree([](auto x, auto y) { return pow(x, 2.5) + pow(1.5, y) * pow(x, y); }, p, q);
    agree([](auto x, auto y) { return sin(x * y) + cos(x - y) * tan(x); }, p, q);
    agree([](auto x, auto y) { return asin(0.4 * x) - acos(0.4 * x * y) * atan(y); }, p, q);
    agree(
        [](auto x, auto y) { return atan2(x, y) * hypot(x, y) + sinh(x) * cosh(y) - tanh(x * y); },
        p, q);
    agree([](auto x, auto y) { return abs(x - y) * min(x, 2.0 * y) + max(x * y, 1.0) * max(y, x); },
          p, q);
  };
  all(0.7, 1.3);
  all(1.3, 0.7);
}

TEST(Dual2Batches, ChooseLaneByLane) {
  static_assert(B::size >= 2);
  double values[B::size] = {-2, 3};
  const auto x = Dual2<B, 2>::variable(B::load_unaligned(values), 0);
  const Dual2<B, 2> a = abs(x), m = min(x, 0.5 * x);
  EXPECT_EQ(a.v.get(0), 2);
  EXPECT_EQ(a.d[0].get(0), -1);
  EXPECT_EQ(a.d[0].get(1), 1);
  EXPECT_EQ(m.d[0].get(0), 1);
  EXPECT_EQ(m.d[0].get(1), 0.5);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
