// Bernstein algebra: order, basis functions, elevation, products.
#include "majorant/elements/bernstein.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "exact_polynomials.h"
#include "support.h"

namespace majorant {
namespace {

using test::Random;
using test::Rational;

// VTK_LAGRANGE_TRIANGLE: corners, edges, then the inner triangle.
TEST(TriangleIndices, VtkOrder) {
  const std::vector<std::vector<MultiIndex>> expected = {
      {{0, 0, 0}},
      {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
      {{2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}},
      {{3, 0, 0},
       {0, 3, 0},
       {0, 0, 3},
       {2, 1, 0},
       {1, 2, 0},
       {0, 2, 1},
       {0, 1, 2},
       {1, 0, 2},
       {2, 0, 1},
       {1, 1, 1}},
      {{4, 0, 0},
       {0, 4, 0},
       {0, 0, 4},
       {3, 1, 0},
       {2, 2, 0},
       {1, 3, 0},
       {0, 3, 1},
       {0, 2, 2},
       {0, 1, 3},
       {1, 0, 3},
       {2, 0, 2},
       {3, 0, 1},
       {2, 1, 1},
       {1, 2, 1},
       {1, 1, 2}}};
  for (std::size_t n = 0; n < expected.size(); ++n) {
    const TriangleIndices& ix = TriangleIndices::of_degree(static_cast<int>(n));
    ASSERT_EQ(ix.count(), static_cast<int>(expected[n].size()));
    for (int l = 0; l < ix.count(); ++l)
      EXPECT_EQ(ix.multi(l), expected[n][static_cast<std::size_t>(l)]);
  }
  EXPECT_EQ(TriangleIndices::of_degree(6).multi(18), (MultiIndex{4, 1, 1}));
  EXPECT_EQ(TriangleIndices::of_degree(6).multi(27), (MultiIndex{2, 2, 2}));
}

TEST(TriangleIndices, LookupEdgesAndMultinomials) {
  for (int n = 0; n <= TriangleIndices::kMaxDegree; ++n) {
    const TriangleIndices& ix = TriangleIndices::of_degree(n);
    ASSERT_EQ(ix.count(), control_point_count(n));
    for (int l = 0; l < ix.count(); ++l) {
      const MultiIndex& m = ix.multi(l);
      EXPECT_EQ(m[0] + m[1] + m[2], n);
      EXPECT_EQ(ix.local(m[0], m[1], m[2]), l);
      EXPECT_EQ(Rational(ix.multinomial(l)), test::multinomial(m));
    }
    for (int e = 0; e < 3; ++e) {
      ASSERT_EQ(ix.edge(e).size(), static_cast<std::size_t>(n) + 1);
      for (int s = 0; s <= n; ++s) {
        const MultiIndex& m = ix.multi(ix.edge(e)[static_cast<std::size_t>(s)]);
        EXPECT_EQ(m[static_cast<std::size_t>(e)], n - s);
        EXPECT_EQ(m[static_cast<std::size_t>((e + 1) % 3)], s);
      }
    }
  }
  EXPECT_THROW(TriangleIndices::of_degree(TriangleIndices::kMaxDegree + 1), std::out_of_range);
  EXPECT_THROW(TriangleIndices::of_degree(-1), std::out_of_range);
}

TEST(TriangleIndices, DegreeFromControlPoints) {
  int n = 0;
  for (int count = 1; count <= 231; ++count) {
    if (count == control_point_count(n))
      EXPECT_EQ(degree_from_control_points(count), n++);
    else
      EXPECT_EQ(degree_from_control_points(count), -1);
  }
  EXPECT_EQ(n, 21);
}

class Bernstein : public testing::TestWithParam<int> {};

TEST_P(Bernstein, PartitionOfUnityAndLinearPrecision) {
  const int n = GetParam();
  Random random(1);
  const TriangleIndices& ix = TriangleIndices::of_degree(n);
  for (int trial = 0; trial < 20; ++trial) {
    const Barycentric xi = random.barycentric();
    const Vec b = bernstein_values(n, xi);
    const Eigen::MatrixX2d g = bernstein_gradients(n, xi);
    Barycentric mean = Barycentric::Zero();
    Eigen::Matrix<double, 3, 2> slope = Eigen::Matrix<double, 3, 2>::Zero();
    for (int l = 0; l < ix.count(); ++l) {
      const Vector3 m(ix.multi(l)[0], ix.multi(l)[1], ix.multi(l)[2]);
      mean += b[l] * m / std::max(n, 1);
      slope += m / std::max(n, 1) * g.row(l);
      EXPECT_GT(b[l], 0);
    }
    EXPECT_NEAR(b.sum(), 1, 1e-14);
    EXPECT_LE(g.colwise().sum().norm(), 1e-13 * (1 + n));
    if (n == 0) continue;
    EXPECT_LE((mean - xi).norm(), 1e-14);
    Eigen::Matrix<double, 3, 2> expected;
    expected << 1, 0, 0, 1, -1, -1;
    EXPECT_LE((slope - expected).norm(), 1e-13 * n);
  }
}

TEST_P(Bernstein, ValuesAreExactToRounding) {
  const int n = GetParam();
  Random random(2);
  const TriangleIndices& ix = TriangleIndices::of_degree(n);
  const Barycentric xi(0.25, 0.625, 0.125);
  const Vec b = bernstein_values(n, xi);
  for (int l = 0; l < ix.count(); ++l) {
    const MultiIndex& m = ix.multi(l);
    const Rational value = test::multinomial(m) * test::power(Rational(1, 4), m[0]) *
                           test::power(Rational(5, 8), m[1]) * test::power(Rational(1, 8), m[2]);
    EXPECT_NEAR(b[l], static_cast<double>(value), 1e-15 * static_cast<double>(value) * (n + 1));
  }
}

TEST_P(Bernstein, GradientsMatchFiniteDifferences) {
  const int n = GetParam();
  Random random(3);
  const double h = 1e-3;
  for (int trial = 0; trial < 5; ++trial) {
    const Barycentric xi = random.barycentric();
    const Eigen::MatrixX2d g = bernstein_gradients(n, xi);
    for (int d = 0; d < 2; ++d) {
      Barycentric step = Barycentric::Zero();
      step[d] = h;
      step[2] = -h;
      const auto at = [&](double s) { return bernstein_values(n, xi + s * step); };
      // Error of the sixth-order formula: h^6 times a seventh derivative.
      const Vec fd = (45 * (at(1) - at(-1)) - 9 * (at(2) - at(-2)) + (at(3) - at(-3))) / (60 * h);
      EXPECT_LE((fd - g.col(d)).cwiseAbs().maxCoeff(), 1e-10 * (1 + n * n * n));
    }
  }
}

TEST(BernsteinDegrees, ElevationEndsAtTheHighest) {
  EXPECT_EQ(elevation_matrix(TriangleIndices::kMaxDegree - 1).rows(),
            control_point_count(TriangleIndices::kMaxDegree));
  EXPECT_THROW(elevation_matrix(TriangleIndices::kMaxDegree), std::out_of_range);
}

class BernsteinElevation : public Bernstein {};

TEST_P(BernsteinElevation, IsExact) {
  const int n = GetParam();
  Random random(4);
  const Eigen::MatrixXd e = elevation_matrix(n);
  ASSERT_EQ(e.rows(), control_point_count(n + 1));
  ASSERT_EQ(e.cols(), control_point_count(n));
  // Entries are k / (n+1) rounded once; as rationals they represent the same polynomial.
  std::vector<Rational> low, high(static_cast<std::size_t>(e.rows()));
  for (Index c = 0; c < e.cols(); ++c) low.emplace_back(random.integer(-99, 99));
  for (Index r = 0; r < e.rows(); ++r)
    for (Index c = 0; c < e.cols(); ++c) {
      const double k = std::round(e(r, c) * (n + 1));
      ASSERT_EQ(k / (n + 1), e(r, c));
      high[static_cast<std::size_t>(r)] +=
          Rational(static_cast<int>(k), n + 1) * low[static_cast<std::size_t>(c)];
    }
  for (int trial = 0; trial < 3; ++trial) {
    const auto p = test::exact_point(random);
    EXPECT_EQ(test::evaluate(n, low, p), test::evaluate(n + 1, high, p));
  }
}

TEST_P(BernsteinElevation, KeepsGradients) {
  const int n = GetParam();
  Random random(5);
  const Vec c = random.vector(control_point_count(n));
  const Vec higher = elevation_matrix(n) * c;
  for (int trial = 0; trial < 10; ++trial) {
    const Barycentric xi = random.barycentric();
    EXPECT_LE((bernstein_gradients(n, xi).transpose() * c -
               bernstein_gradients(n + 1, xi).transpose() * higher)
                  .norm(),
              1e-13 * (n + 1));
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees, Bernstein, testing::Values(0, 1, 2, 3, 4, 5, 6, 7, 8, 14, 20));
INSTANTIATE_TEST_SUITE_P(Degrees, BernsteinElevation,
                         testing::Values(0, 1, 2, 3, 4, 5, 6, 7, 8, 14,
                                         TriangleIndices::kMaxDegree - 1));

TEST(BernsteinProduct, IsThePointwiseProduct) {
  Random random(6);
  for (int m = 0; m <= 8; ++m)
    for (int n = 0; n <= 8; ++n) {
      const Vec a = random.vector(control_point_count(m)),
                b = random.vector(control_point_count(n));
      const Vec p = multiply(m, a, n, b);
      ASSERT_EQ(p.size(), control_point_count(m + n));
      EXPECT_LE((p - multiply(n, b, m, a)).norm(), 1e-14 * p.norm());
      const Barycentric xi = random.barycentric();
      EXPECT_NEAR(bernstein_values(m + n, xi).dot(p),
                  bernstein_values(m, xi).dot(a) * bernstein_values(n, xi).dot(b), 1e-14);
    }
}

TEST(BernsteinProduct, CornersMultiply) {
  Random random(7);
  const Vec a = random.vector(10), b = random.vector(15);
  const Vec p = multiply(3, a, 4, b);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(p[k], a[k] * b[k]);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
