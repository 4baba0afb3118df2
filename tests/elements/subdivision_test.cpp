// Bisection of Bernstein coefficients against exact rationals, for every element.
#include <gtest/gtest.h>

#include "element_maps.h"
#include "majorant/elements/positivity.h"

namespace majorant {
namespace {

using test::Random;
using test::Rational;

// bisect() finds half() by argument-dependent lookup.
struct Exact {
  Rational q;
  friend Exact operator+(const Exact& a, const Exact& b) { return {a.q + b.q}; }
  friend Exact half(const Exact& a) { return {a.q / 2}; }
};

// An element's subdivision of polynomials of some degree, which may differ from that of its det J.
struct SubdivisionCase {
  test::ElementCase element;
  int degree;
};

std::vector<SubdivisionCase> cases_of(const std::vector<int>& degrees) {
  std::vector<SubdivisionCase> out;
  for (const test::ElementCase& c : test::all_elements())
    if (c.degree == 1)
      for (const int degree : degrees)
        if (degree <= (c.name == "triangle"                             ? 14
                       : test::is_spatial_product(c.space()->element()) ? 4
                                                                        : 8))
          out.push_back({c, degree});
  return out;
}

class Bisect : public testing::TestWithParam<SubdivisionCase> {
 protected:
  const BernsteinElement& element() const { return space_->element(); }
  Degrees degrees() const { return Degrees(element().factors.size(), GetParam().degree); }
  std::shared_ptr<const BernsteinSpace> space_ = GetParam().element.space();
  const BernsteinBasis basis_ = element().basis(degrees());
  const Subdivision cell_{basis_, element().bisections};
  const std::size_t size_ = static_cast<std::size_t>(basis_.count());
};

test::ExactPolynomial polynomial(const BernsteinBasis& basis, const std::vector<Exact>& c) {
  test::ExactPolynomial p;
  for (int k = 0; k < basis.count(); ++k)
    p.add(basis.exponents(k), test::exact_weight(basis.factors(), basis.exponents(k)) *
                                  c[static_cast<std::size_t>(k)].q);
  return p;
}

// Returns point x of a child in the coordinates of its parent.
std::vector<Rational> in_parent(const EdgeBisection& step, const std::vector<int>& slots,
                                const std::vector<Rational>& x) {
  std::vector<Rational> out(x.size());
  for (std::size_t s = 0; s < x.size(); ++s)
    if (slots[s] == EdgeBisection::kMidpoint) {
      out[static_cast<std::size_t>(step.a)] += x[s] / 2;
      out[static_cast<std::size_t>(step.b)] += x[s] / 2;
    } else {
      out[static_cast<std::size_t>(slots[s])] += x[s];
    }
  return out;
}

TEST_P(Bisect, ChildrenAreTheParentOnItsHalves) {
  Random random(1);
  std::vector<Exact> parent(size_), first(size_), second(size_);
  for (Exact& c : parent) c.q = random.integer(-1000, 1000);
  const test::ExactPolynomial whole = polynomial(basis_, parent);
  for (std::size_t k = 0; k < element().bisections.size(); ++k) {
    const EdgeBisection& step = element().bisections[k];
    cell_.bisect(static_cast<int>(k), parent.data(), first.data(), second.data());
    const auto one = polynomial(basis_, first), two = polynomial(basis_, second);
    for (int trial = 0; trial < 6; ++trial) {
      std::vector<Rational> x;
      for (const double c : test::random_coordinates(element().factors, random))
        x.emplace_back(static_cast<int>(c * 64), 64);
      std::size_t at = 0;  // the last coordinate of each factor is 1 minus the others
      for (const int corners : element().factors) {
        Rational sum = 0;
        for (int c = 0; c + 1 < corners; ++c) sum += x[at++];
        x[at++] = 1 - sum;
      }
      EXPECT_EQ(one(x), whole(in_parent(step, step.first, x)));
      EXPECT_EQ(two(x), whole(in_parent(step, step.second, x)));
    }
  }
}

// certify_positive() adds 1.01 levels u max|a|: one ulp of the largest coefficient per average.
TEST_P(Bisect, RoundingStaysBelowTheClaim) {
  Random random(2);
  std::vector<double> parent(size_), first(size_), second(size_);
  std::vector<Exact> exact_parent(size_), exact_first(size_), exact_second(size_);
  double largest = 0;
  for (std::size_t k = 0; k < size_; ++k) {
    parent[k] = random.uniform();
    exact_parent[k].q = Rational(parent[k]);
    largest = std::max(largest, std::abs(parent[k]));
  }
  for (int depth = 0; depth < 6; ++depth) {
    EXPECT_EQ(cell_.levels(depth), GetParam().degree);
    cell_.bisect(depth, parent.data(), first.data(), second.data());
    cell_.bisect(depth, exact_parent.data(), exact_first.data(), exact_second.data());
    const Rational bound(1.01 * cell_.levels(depth) * 0x1p-53 * largest);
    for (std::size_t k = 0; k < size_; ++k) {
      EXPECT_LE(abs(Rational(first[k]) - exact_first[k].q), bound);
      EXPECT_LE(abs(Rational(second[k]) - exact_second[k].q), bound);
    }
  }
}

TEST_P(Bisect, CornersAreValues) {
  Random random(3);
  std::vector<Exact> c(size_);
  for (Exact& x : c) x.q = random.integer(-9, 9);
  const test::ExactPolynomial p = polynomial(basis_, c);
  const std::size_t expected =
      GetParam().degree == 0 ? 1 : static_cast<std::size_t>(element().corner_count());
  ASSERT_EQ(cell_.corners().size(), expected);
  for (const int k : cell_.corners()) {
    std::vector<Rational> x;
    for (int i = 0; i < basis_.coordinate_count(); ++i)
      x.emplace_back(basis_.exponents(k)[static_cast<std::size_t>(i)] > 0 ? 1 : 0);
    if (GetParam().degree > 0) {
      EXPECT_EQ(p(x), c[static_cast<std::size_t>(k)].q);
    }
  }
}

// After a full cycle edge lengths are halved: cells do not degenerate. Corners are linear functions
// of the reference coordinates.
class BisectLinear : public Bisect {};
TEST_P(BisectLinear, EdgesShrinkForGood) {
  const int dim = element().dim();
  const std::function<void(int, std::vector<std::vector<double>>)> check =
      [&](int depth, const std::vector<std::vector<double>>& coordinates) {
        const double diameter = std::pow(0.5, depth / dim) * 2;
        for (const int i : cell_.corners())
          for (const int j : cell_.corners()) {
            double distance = 0;
            for (const auto& x : coordinates)
              distance = std::max(distance, std::abs(x[static_cast<std::size_t>(i)] -
                                                     x[static_cast<std::size_t>(j)]));
            ASSERT_LE(distance, diameter);
          }
        if (depth == 4 * dim) return;
        auto first = coordinates, second = coordinates;
        for (std::size_t d = 0; d < coordinates.size(); ++d)
          cell_.bisect(depth, coordinates[d].data(), first[d].data(), second[d].data());
        check(depth + 1, first);
        check(depth + 1, second);
      };
  std::vector<std::vector<double>> coordinates;
  for (const auto& [plus, minus] : element().derivatives) {
    coordinates.emplace_back();
    for (int k = 0; k < basis_.count(); ++k)
      coordinates.back().push_back(basis_.exponents(k)[static_cast<std::size_t>(plus)] > 0);
  }
  check(0, coordinates);
}

const auto case_name = [](const auto& c) {
  return c.param.element.name + "_degree_" + std::to_string(c.param.degree);
};
INSTANTIATE_TEST_SUITE_P(All, Bisect, testing::ValuesIn(cases_of({0, 1, 2, 3, 4, 6, 8, 14})),
                         case_name);
INSTANTIATE_TEST_SUITE_P(All, BisectLinear, testing::ValuesIn(cases_of({1})), case_name);

TEST(BisectOrder, TrianglesSplitTheEdgeOppositeCornerZero) {
  const auto space = test::all_elements().front().space();
  const Subdivision cell(space->element().basis({1}), space->element().bisections);
  const double parent[3] = {1, 10, 100};
  double plus[3], minus[3];
  cell.bisect(0, parent, plus, minus);
  EXPECT_EQ(std::vector<double>(plus, plus + 3), (std::vector<double>{55, 1, 10}));
  EXPECT_EQ(std::vector<double>(minus, minus + 3), (std::vector<double>{55, 100, 1}));
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
