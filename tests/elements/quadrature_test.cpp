// Quadrature rules: exactness, positivity, symmetry.
#include "majorant/elements/quadrature.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>

#include "exact_polynomials.h"
#include "majorant/framework/error.h"
#include "support.h"

namespace majorant {
namespace {

// Returns the mean of xi0^i xi1^j xi2^k over the triangle: 2 i! j! k! / (i + j + k + 2)!.
double exact_mean(int i, int j, int k) {
  return static_cast<double>(test::Rational(2 * test::factorial(i) * test::factorial(j) *
                                            test::factorial(k) / test::factorial(i + j + k + 2)));
}

double mean(const Quadrature& q, int i, int j, int k) {
  double sum = 0;
  for (Index l = 0; l < q.size(); ++l)
    sum += q.weights[l] * std::pow(q.points(l, 0), i) * std::pow(q.points(l, 1), j) *
           std::pow(q.points(l, 2), k);
  return sum;
}

int exactness(const Quadrature& q) {
  for (int degree = 0; degree <= 15; ++degree)
    for (int i = 0; i <= degree; ++i)
      for (int j = 0; j <= degree - i; ++j) {
        const double e = exact_mean(i, j, degree - i - j);
        if (std::abs(mean(q, i, j, degree - i - j) - e) > 1e-13 * e) return degree - 1;
      }
  return 15;
}

void expect_sound(const Quadrature& q) {
  ASSERT_EQ(q.points.rows(), q.size());
  EXPECT_NEAR(q.weights.sum(), 1, 1e-13);
  EXPECT_GT(q.weights.minCoeff(), 0);
  EXPECT_GE(q.points.minCoeff(), 0);
  EXPECT_LE((q.points.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-14);
}

// Expects that every permutation of the corners gives the same set of weighted points.
void expect_symmetric(const Quadrature& q) {
  using Point = std::array<double, 4>;
  const auto sorted = [&](const std::array<int, 3>& permutation) {
    std::vector<Point> out;
    for (Index l = 0; l < q.size(); ++l) {
      Point p;
      for (std::size_t k = 0; k < 3; ++k)
        p[k] = std::round(q.points(l, permutation[k]) * 1e10) / 1e10;
      p[3] = std::round(q.weights[l] * 1e13) / 1e13;
      out.push_back(p);
    }
    std::sort(out.begin(), out.end());
    return out;
  };
  const auto reference = sorted({0, 1, 2});
  for (const std::array<int, 3>& permutation :
       {std::array{1, 0, 2}, {2, 1, 0}, {0, 2, 1}, {1, 2, 0}, {2, 0, 1}})
    EXPECT_EQ(sorted(permutation), reference);
}

TEST(Quadrature, LatticeIsExactForLinearFunctions) {
  for (const int m : {1, 2, 3, 8, 12, 40}) {
    const Quadrature q = lattice_rule(m);
    EXPECT_EQ(q.size(), m * (m + 1) / 2);
    EXPECT_EQ(exactness(q), m == 2 ? 2 : 1);
    EXPECT_GT(q.points.minCoeff(), 0);  // none on the boundary
    expect_sound(q);
    expect_symmetric(q);
  }
  // Second gradient_products of method.md E5.
  EXPECT_NEAR(mean(lattice_rule(8), 2, 0, 0), 0.171875, 5e-7);
  EXPECT_NEAR(mean(lattice_rule(12), 2, 0, 0), 0.170525, 5e-7);
  EXPECT_NEAR(mean(lattice_rule(100), 2, 0, 0), 0.167211, 5e-7);
}

TEST(Quadrature, RadonIsExactForDegreeFive) {
  const Quadrature q = radon_rule();
  EXPECT_EQ(q.size(), 7);
  EXPECT_EQ(exactness(q), 5);
  expect_sound(q);
  expect_symmetric(q);
}

TEST(Quadrature, CompositeKeepsExactnessAndConverges) {
  const double fine_error =
      std::abs(mean(composite_rule(radon_rule(), 6), 6, 0, 0) - exact_mean(6, 0, 0));
  const double coarse_error = std::abs(mean(radon_rule(), 6, 0, 0) - exact_mean(6, 0, 0));
  EXPECT_LT(fine_error, coarse_error / 1000);
  for (const int m : {1, 2, 3, 7}) {
    const Quadrature q = composite_rule(radon_rule(), m);
    EXPECT_EQ(q.size(), 7 * m * m);
    EXPECT_EQ(exactness(q), 5);
    expect_sound(q);
    expect_symmetric(q);
    EXPECT_EQ(exactness(composite_rule(lattice_rule(1), m)), 1);
  }
}

TEST(Quadrature, CornerGradingAddsPointsAtTheCornersOnly) {
  for (const int m : {2, 3})
    for (const int levels : {1, 2, 4}) {
      const Quadrature q = corner_graded_rule(radon_rule(), m, levels);
      // Each level replaces a corner triangle by four.
      EXPECT_EQ(q.size(), 7 * (m * m + 9 * levels));
      EXPECT_EQ(exactness(q), 5);
      expect_sound(q);
      expect_symmetric(q);
      const Quadrature coarse = composite_rule(radon_rule(), m);
      EXPECT_NEAR(1 - q.points.maxCoeff(), (1 - coarse.points.maxCoeff()) / (1 << levels), 1e-14);
    }
}

TEST(Quadrature, GradingOfTheWholeTriangle) {
  const Quadrature q = corner_graded_rule(radon_rule(), 1, 2);
  EXPECT_EQ(q.size(), 7 * (4 + 9));
  EXPECT_EQ(exactness(q), 5);
  expect_sound(q);
  expect_symmetric(q);
}

TEST(Quadrature, GuardPoints) {
  for (const int m : {1, 2, 4}) {
    const Quadrature q = guarded_rule(lattice_rule(8), m, 1e-3);
    EXPECT_EQ(q.size(), 36 + control_point_count(m));
    EXPECT_EQ(q.points.maxCoeff(), 1.0);
    EXPECT_NEAR(q.weights.tail(control_point_count(m)).sum(), 1e-3, 1e-15);
    EXPECT_GE(exactness(q), 1);
    expect_sound(q);
    expect_symmetric(q);
  }
}

// ---- Tetrahedra: barycentric points. ----

int tetrahedron_exactness(const Quadrature& q) {
  for (int degree = 0; degree <= 11; ++degree)
    for (int i = 0; i <= degree; ++i)
      for (int j = 0; j <= degree - i; ++j)
        for (int k = 0; k <= degree - i - j; ++k) {
          const int l = degree - i - j - k;
          double sum = 0;
          for (Index p = 0; p < q.size(); ++p)
            sum += q.weights[p] * std::pow(q.points(p, 0), i) * std::pow(q.points(p, 1), j) *
                   std::pow(q.points(p, 2), k) * std::pow(q.points(p, 3), l);
          const auto exact = static_cast<double>(
              test::Rational(6 * test::factorial(i) * test::factorial(j) * test::factorial(k) *
                             test::factorial(l) / test::factorial(degree + 3)));
          if (std::abs(sum - exact) > 1e-13 * exact) return degree - 1;
        }
  return 11;
}

// Returns points and weights after a renumbering of coordinates, in a fixed order.
std::vector<std::vector<double>> renumbered(const Quadrature& q, const std::vector<int>& order) {
  std::vector<std::vector<double>> out;
  for (Index l = 0; l < q.size(); ++l) {
    out.emplace_back();
    for (const int c : order) out.back().push_back(std::round(q.points(l, c) * 1e10) / 1e10);
    out.back().push_back(std::round(q.weights[l] * 1e12) / 1e12);
  }
  std::sort(out.begin(), out.end());
  return out;
}

void expect_tetrahedron_rule(const Quadrature& q, int exactness) {
  expect_sound(q);
  EXPECT_EQ(tetrahedron_exactness(q), exactness);
  std::vector<int> order{0, 1, 2, 3};
  const auto reference = renumbered(q, order);
  while (std::next_permutation(order.begin(), order.end()))
    EXPECT_EQ(renumbered(q, order), reference);
}

TEST(Quadrature, WalkingtonIsExactForDegreeFive) {
  EXPECT_EQ(walkington_rule().size(), 14);
  expect_tetrahedron_rule(walkington_rule(), 5);
}

TEST(Quadrature, CompositeTetrahedraKeepExactnessAndSymmetry) {
  for (const int m : {1, 2, 3, 4}) {
    const Quadrature q = composite_rule(walkington_rule(), m);
    EXPECT_EQ(q.size(), 14 * ((m * m * m + 2 * m) / 3 + 8 * (m * m * m - m) / 6));
    expect_tetrahedron_rule(q, 5);
  }
}

// ---- By degree. ----

TEST(Quadrature, ExactRulesOfTriangles) {
  EXPECT_EQ(highest_exactness({3}), 12);
  const int exact[] = {1, 1, 2, 4, 4, 5, 6, 8, 8, 10, 10, 12, 12};
  const Index sizes[] = {1, 1, 3, 6, 6, 7, 12, 16, 16, 25, 25, 33, 33};
  for (int degree = 0; degree <= 12; ++degree) {
    const Quadrature q = exact_rule({3}, degree);
    EXPECT_EQ(q.size(), sizes[degree]);
    expect_sound(q);
    EXPECT_EQ(exactness(q), exact[degree]);
    expect_symmetric(q);
  }
}

TEST(Quadrature, ExactRulesOfTetrahedra) {
  EXPECT_EQ(highest_exactness({4}), 8);
  const int exact[] = {1, 1, 2, 5, 5, 5, 6, 8, 8};
  const Index sizes[] = {1, 1, 4, 14, 14, 14, 24, 46, 46};
  for (int degree = 0; degree <= 8; ++degree) {
    const Quadrature q = exact_rule({4}, degree);
    EXPECT_EQ(q.size(), sizes[degree]);
    expect_tetrahedron_rule(q, exact[degree]);
  }
}

TEST(Quadrature, ExactRulesOfProducts) {
  const auto same = [](const Quadrature& a, const Quadrature& b) {
    EXPECT_EQ(a.cell, b.cell);
    EXPECT_EQ(a.points, b.points);
    EXPECT_EQ(a.weights, b.weights);
  };
  for (int m = 1; m <= 9; ++m) same(exact_rule({2}, 2 * m - 1), gauss_rule(m));
  same(exact_rule({2}, 4), gauss_rule(3));
  same(exact_rule({2, 2}, 5), tensor_gauss_rule(3));
  same(exact_rule({3, 2}, 5), product_rule(radon_rule(), gauss_rule(3)));
  same(exact_rule({2, 2, 2}, 3), product_rule(tensor_gauss_rule(2), gauss_rule(2)));
  same(exact_rule({4}, 3), walkington_rule());
  EXPECT_EQ(highest_exactness({2, 3}), highest_exactness({3}));
  EXPECT_GT(highest_exactness({2, 2}), 1000);
}

// ---- Rules know their cells. ----

std::string refusal(const Quadrature& rule, const Factors& cell) {
  try {
    require_cell(rule, cell, "space");
  } catch (const InvalidArgument& e) {
    return e.what();
  }
  return "";
}

TEST(Quadrature, RulesOfAnotherCellAreRefused) {
  const Quadrature line = gauss_rule(2), square = tensor_gauss_rule(2);
  const std::vector<Quadrature> rules{line,
                                      square,
                                      radon_rule(),
                                      walkington_rule(),
                                      product_rule(square, line),
                                      product_rule(radon_rule(), line),
                                      product_rule(line, radon_rule())};
  for (const Quadrature& a : rules)
    for (const Quadrature& b : rules) EXPECT_EQ(refusal(a, b.cell).empty(), &a == &b);
  EXPECT_EQ(refusal(product_rule(square, line), {3}),
            "space: quadrature of the cell {2, 2, 2}, {3} is needed (corners of each factor)");
}

TEST(Quadrature, InvalidRulesAreRefused) {
  const auto refused = [](const std::function<void(Quadrature&)>& spoil, const std::string& why) {
    Quadrature q = product_rule(radon_rule(), gauss_rule(2));
    spoil(q);
    EXPECT_NE(refusal(q, {3, 2}).find(why), std::string::npos) << refusal(q, {3, 2});
  };
  refused([](auto& q) { q.points = RowMatrix(q.points.leftCols(3)); }, "4 columns are needed");
  refused([](auto& q) { q.weights = Vec(q.weights.head(5)); }, "with 5 weights and 14 by 4 points");
  refused([](auto& q) { q = Quadrature{{3, 2}, RowMatrix(0, 4), Vec(0)}; }, "with 0 weights");
  refused([](auto& q) { q.weights *= 0.5; }, "add to 0.5");
  refused([](auto& q) { q.weights[3] = std::nan(""); }, "add to nan");
  refused([](auto& q) { q.points(2, 0) += 0.01; }, "point 2 is outside");
  refused([](auto& q) { q.points(4, 3) = 1.01; }, "point 4 is outside");
  refused([](auto& q) { q.points(4, 3) = std::nan(""); }, "point 4 is outside");
  EXPECT_THROW(corner_graded_rule(tensor_gauss_rule(2), 2, 1), InvalidArgument);
  EXPECT_THROW(composite_rule(Quadrature{}, 2), InvalidArgument);
  EXPECT_THROW(guarded_rule(Quadrature{{5}, RowMatrix::Constant(1, 5, 0.2), Vec::Ones(1)}, 1, 0.1),
               InvalidArgument);
}

// ---- Products: a wedge. ----

TEST(Quadrature, ProductsAreExactInEachFactor) {
  const Quadrature wedge = product_rule(radon_rule(), gauss_rule(3));
  EXPECT_EQ(wedge.cell, (Factors{3, 2}));
  for (const Quadrature& q : {wedge, composite_rule(wedge, 3), composite_rule(wedge, 1)})
    for (int i = 0; i <= 5; ++i)
      for (int k = 0; k <= 5; ++k) {
        double sum = 0;
        for (Index l = 0; l < q.size(); ++l)
          sum += q.weights[l] * std::pow(q.points(l, 1), i) * std::pow(q.points(l, 3), k);
        EXPECT_NEAR(sum, exact_mean(0, i, 0) / (k + 1), 1e-14);
      }
  EXPECT_EQ(composite_rule(wedge, 3).size(), 27 * wedge.size());
  const Quadrature guarded = guarded_rule(wedge, 2, 1e-3);
  EXPECT_EQ(guarded.size(), wedge.size() + 6 * 3);
  EXPECT_NEAR(guarded.weights.tail(18).sum(), 1e-3, 1e-15);
  EXPECT_EQ(refusal(guarded, {3, 2}), "");
}

// ---- The unit square: points (s, t). ----

double square_mean(const Quadrature& q, int i, int j) {
  double sum = 0;
  for (Index l = 0; l < q.size(); ++l)
    sum += q.weights[l] * std::pow(q.points(l, 0), i) * std::pow(q.points(l, 1), j);
  return sum;
}

// Returns the largest degree in s and in t.
int square_exactness(const Quadrature& q) {
  for (int degree = 0; degree <= 20; ++degree)
    for (int i = 0; i <= degree; ++i)
      for (const auto& [a, b] : {std::pair{i, degree}, {degree, i}})
        if (std::abs(square_mean(q, a, b) * (a + 1) * (b + 1) - 1) > 1e-12) return degree - 1;
  return 20;
}

void expect_square_rule(const Quadrature& q, int exactness) {
  EXPECT_NEAR(q.weights.sum(), 1, 1e-13);
  EXPECT_GT(q.weights.minCoeff(), 0);
  EXPECT_GE(q.points.minCoeff(), 0);
  EXPECT_LE(q.points.maxCoeff(), 1);
  EXPECT_EQ(square_exactness(q), exactness);
  Quadrature mirrored = q;
  mirrored.points.col(0) = 1 - q.points.col(0).array();
  EXPECT_EQ(renumbered(q, {0, 1}), renumbered(q, {1, 0}));
  EXPECT_EQ(renumbered(q, {0, 1}), renumbered(mirrored, {0, 1}));
}

TEST(Quadrature, TensorGaussIsExact) {
  for (const int m : {1, 2, 3, 4, 7, 10}) {
    EXPECT_EQ(tensor_gauss_rule(m).size(), m * m);
    expect_square_rule(tensor_gauss_rule(m), 2 * m - 1);
  }
}

TEST(Quadrature, CompositeSquaresKeepExactness) {
  for (const int m : {1, 2, 3}) {
    EXPECT_EQ(composite_rule(tensor_gauss_rule(3), m).size(), 9 * m * m);
    expect_square_rule(composite_rule(tensor_gauss_rule(3), m), 5);
  }
}

TEST(Quadrature, GuardPointsOfOtherCells) {
  for (const int m : {1, 2, 4}) {
    const Quadrature tetrahedron = guarded_rule(walkington_rule(), m, 1e-3);
    const int guards = (m + 1) * (m + 2) * (m + 3) / 6;
    EXPECT_EQ(tetrahedron.size(), 14 + guards);
    EXPECT_NEAR(tetrahedron.weights.tail(guards).sum(), 1e-3, 1e-15);
    EXPECT_EQ(tetrahedron.points.maxCoeff(), 1);
    expect_tetrahedron_rule(tetrahedron, 1);
    const Quadrature square = guarded_rule(tensor_gauss_rule(2), m, 1e-3);
    EXPECT_EQ(square.size(), 4 + (m + 1) * (m + 1));
    EXPECT_NEAR(square.weights.tail((m + 1) * (m + 1)).sum(), 1e-3, 1e-15);
    expect_square_rule(square, 1);
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
