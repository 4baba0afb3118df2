// Second-order forward differentiation against closed forms.
#include "majorant/energies/detail/dual2.h"

#include <gtest/gtest.h>

#include <xsimd/xsimd.hpp>

#include "support.h"

namespace majorant {
namespace {

using D = Dual2<double, 2>;

void expect_equal(const D& f, double v, Vector2 g, double xx, double xy, double yy) {
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
    expect_equal(x * y, p * q, {q, p}, 0, 1, 0);
    expect_equal(x / y, p / q, {1 / q, -p / (q * q)}, 0, -1 / (q * q), 2 * p / (q * q * q));
    expect_equal(2.0 / x, 2 / p, {-2 / (p * p), 0}, 4 / (p * p * p), 0, 0);
    expect_equal(x / 2.0, p / 2, {0.5, 0}, 0, 0, 0);
    expect_equal(1.0 - x, 1 - p, {-1, 0}, 0, 0, 0);
    expect_equal(x - 1.0 + y, p - 1 + q, {1, 1}, 0, 0, 0);
    expect_equal(1.0 + x - y, 1 + p - q, {1, -1}, 0, 0, 0);
    expect_equal(-x * 3.0, -3 * p, {-3, 0}, 0, 0, 0);
    const double r = std::sqrt(p * q);
    expect_equal(sqrt(x * y), r, {r / (2 * p), r / (2 * q)}, -r / (4 * p * p), r / (4 * p * q),
                 -r / (4 * q * q));
    expect_equal(log(x * y), std::log(p * q), {1 / p, 1 / q}, -1 / (p * p), 0, -1 / (q * q));
    const double e = std::exp(p * q);
    expect_equal(exp(x * y), e, {q * e, p * e}, q * q * e, (1 + p * q) * e, p * p * e);
  }
}

TEST(Dual2, BatchesAgreeWithDoubles) {
  using B = xsimd::batch<double>;
  const auto f = [](const auto& x, const auto& y) {
    return sqrt(x * x + y) / (1.0 + x) - 2.0 * log(y) + exp(x - y) * 0.5;
  };
  const auto [x, y] = dual2_variables<double>(0.7, 1.3);
  const auto [bx, by] = dual2_variables<B>(B(0.7), B(1.3));
  const D s = f(x, y);
  const Dual2<B, 2> b = f(bx, by);
  EXPECT_DOUBLE_EQ(b.v.get(0), s.v);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_DOUBLE_EQ(b.d[k].get(1), s.d[k]);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_DOUBLE_EQ(b.h[k].get(0), s.h[k]);
}

}  // namespace
}  // namespace majorant
