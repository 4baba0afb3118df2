// Newest-vertex bisection of Bernstein coefficients against exact rationals.
#include <gtest/gtest.h>

#include "majorant/elements/bernstein.h"
#include "support.h"

namespace majorant {
namespace {

using test::ExactPoint;
using test::Random;
using test::Rational;

// bisect() finds half() by its argument's namespace.
struct Exact {
  Rational q;
  friend Exact operator+(const Exact& a, const Exact& b) { return {a.q + b.q}; }
  friend Exact half(const Exact& a) { return {a.q / 2}; }
};

std::vector<Rational> rationals(const std::vector<Exact>& v) {
  std::vector<Rational> out;
  for (const Exact& e : v) out.push_back(e.q);
  return out;
}

class Bisect : public testing::TestWithParam<int> {};

TEST_P(Bisect, ChildrenAreTheParentOnItsHalves) {
  const int n = GetParam();
  const auto size = static_cast<std::size_t>(control_point_count(n));
  Random random(1);
  std::vector<Exact> parent(size), plus(size), minus(size);
  for (Exact& c : parent) c.q = random.integer(-1000, 1000);
  bisect(n, parent.data(), plus.data(), minus.data());
  for (int trial = 0; trial < 8; ++trial) {
    const ExactPoint p = test::exact_point(random);
    const Rational half_a = p.a / 2;
    // plus lives on (M, P0, P1), minus on (M, P2, P0), M = (P1 + P2) / 2.
    const ExactPoint in_plus{p.b, half_a + p.c, half_a}, in_minus{p.c, half_a, half_a + p.b};
    EXPECT_EQ(test::evaluate(n, rationals(plus), p), test::evaluate(n, rationals(parent), in_plus));
    EXPECT_EQ(test::evaluate(n, rationals(minus), p),
              test::evaluate(n, rationals(parent), in_minus));
  }
}

// certify_positive() adds 1.01 n u max|a| per level: one ulp of the largest coefficient per
// average.
TEST_P(Bisect, RoundingStaysBelowTheClaim) {
  const int n = GetParam();
  const auto size = static_cast<std::size_t>(control_point_count(n));
  Random random(2);
  std::vector<double> parent(size), plus(size), minus(size);
  std::vector<Exact> exact_parent(size), exact_plus(size), exact_minus(size);
  double largest = 0;
  for (std::size_t k = 0; k < size; ++k) {
    parent[k] = random.uniform();
    exact_parent[k].q = Rational(parent[k]);
    largest = std::max(largest, std::abs(parent[k]));
  }
  bisect(n, parent.data(), plus.data(), minus.data());
  bisect(n, exact_parent.data(), exact_plus.data(), exact_minus.data());
  const Rational bound(1.01 * n * 0x1p-53 * largest);
  for (std::size_t k = 0; k < size; ++k) {
    EXPECT_LE(abs(Rational(plus[k]) - exact_plus[k].q), bound);
    EXPECT_LE(abs(Rational(minus[k]) - exact_minus[k].q), bound);
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees, Bisect, testing::Values(0, 1, 2, 3, 4, 6, 8, 10, 14));

TEST(BisectOrder, SplitsTheEdgeOppositeCornerZero) {
  const double parent[3] = {1, 10, 100};
  double plus[3], minus[3];
  bisect(1, parent, plus, minus);
  EXPECT_EQ(std::vector<double>(plus, plus + 3), (std::vector<double>{55, 1, 10}));
  EXPECT_EQ(std::vector<double>(minus, minus + 3), (std::vector<double>{55, 100, 1}));
}

}  // namespace
}  // namespace majorant
