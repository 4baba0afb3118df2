// Bernstein coefficients of det J against exact rational arithmetic, and their error bounds, for
// every element.
#include "majorant/elements/det_coefficients.h"

#include <gtest/gtest.h>

#include "element_maps.h"

namespace majorant {
namespace {

using test::Random;
using test::Rational;
using Control = std::vector<double>;  // D numbers per control point

class Det : public testing::TestWithParam<test::ElementCase> {
 protected:
  int n() const { return GetParam().degree; }
  int dim() const { return space_->reference_dim(); }
  const BernsteinElement& element() const { return space_->element(); }
  std::size_t size() const { return static_cast<std::size_t>(det_.count()); }
  std::size_t unknowns() const {
    return static_cast<std::size_t>(dim() * space_->nodes_per_element());
  }
  Control random_control(Random& random) const {
    Control c;
    for (std::size_t k = 0; k < unknowns(); ++k) c.push_back(random.uniform());
    return c;
  }
  // Returns control points close to a line or plane, so that every coefficient cancels almost
  // completely.
  Control nearly_degenerate(Random& random, double height) const {
    Control c;
    while (c.size() < unknowns()) {
      double sum = 0;
      for (int d = 0; d + 1 < dim(); ++d) sum += c.emplace_back(random.uniform(-3, 3));
      c.push_back(sum / 3 + height * random.uniform());
    }
    return c;
  }
  // Returns Bernstein coefficients by polynomial multiplication.
  std::vector<Rational> exact(const Control& c) const {
    const test::ExactPolynomial det = test::exact_det(element(), c);
    std::vector<Rational> out;
    for (int k = 0; k < det_.count(); ++k) {
      const Exponents& e = det_.basis().exponents(k);
      out.push_back(det.coefficient(e) / test::exact_weight(element().factors, e));
    }
    return out;
  }
  std::vector<double> at(const Control& c) const {
    std::vector<double> out(size()), error(size());
    det_.at_with_error(c.data(), out.data(), error.data());
    return out;
  }
  void expect_bounds(const Control& c) const {
    std::vector<double> out(size()), error(size()), fine(size()), fine_error(size());
    const std::vector<Rational> expected = exact(c);
    det_.at_with_error(c.data(), out.data(), error.data());
    det_.at_with_error_quad(c.data(), fine.data(), fine_error.data());
    for (std::size_t t = 0; t < size(); ++t) {
      EXPECT_LE(abs(expected[t] - Rational(out[t])), Rational(error[t])) << "coefficient " << t;
      EXPECT_LE(abs(expected[t] - Rational(fine[t])), Rational(fine_error[t])) << "quadruple " << t;
      EXPECT_LE(fine_error[t], error[t]);
    }
  }

  std::shared_ptr<const BernsteinSpace> space_ = GetParam().space();
  const DetCoefficients det_{element()};
};

// Rationals represent integers of any size.
TEST_P(Det, IntegersGiveTheSameTimesAFactor) {
  Random random(11);
  Control c;
  std::vector<Rational> whole;
  for (std::size_t k = 0; k < unknowns(); ++k)
    whole.emplace_back(c.emplace_back(std::round(random.uniform(-9, 9))));
  Rational factor = 1;
  std::size_t at = 0;
  for (const int corners : element().factors) {
    int degree = 0;
    for (int k = 0; k < corners; ++k) degree += det_.basis().exponents(0)[at++];
    factor *= test::factorial(degree);
  }
  const std::vector<Rational> expected = exact(c), found = det_.scaled(whole);
  for (std::size_t t = 0; t < size(); ++t) EXPECT_EQ(found[t], expected[t] * factor) << t;
}

TEST_P(Det, DegreesAreAsDocumented) {
  // In a factor of dimension k, k derivatives have degree n - 1 and the others n.
  Degrees expected;
  for (const int corners : element().factors) expected.push_back(dim() * n() - (corners - 1));
  const BernsteinBasis basis = element().basis(expected);
  ASSERT_EQ(basis.count(), det_.count());
  for (int k = 0; k < basis.count(); ++k) EXPECT_GE(basis.find(det_.basis().exponents(k)), 0);
}

TEST_P(Det, CoefficientsAreAccurateOnSmallIntegers) {
  Random random(2);
  Control c;
  for (std::size_t k = 0; k < unknowns(); ++k) c.push_back(random.integer(-8, 8));
  const std::vector<Rational> expected = exact(c);
  const std::vector<double> out = at(c);
  for (std::size_t t = 0; t < size(); ++t)
    EXPECT_NEAR(out[t], static_cast<double>(expected[t]), 1e-12 * n() * n() * 1000);
}

TEST_P(Det, ErrorBoundsHoldAndAreSmall) {
  Random random(3);
  const int trials = n() > (test::is_spatial_product(element()) ? 2 : 3) ? 3 : 8;
  for (int trial = 0; trial < trials; ++trial) {
    const Control c = trial == 0 ? random_control(random)
                                 : nearly_degenerate(random, std::pow(10.0, -2.0 * trial));
    expect_bounds(c);
    std::vector<double> out(size()), error(size());
    det_.at_with_error(c.data(), out.data(), error.data());
    EXPECT_LE(*std::max_element(error.begin(), error.end()), 1e-11 * std::pow(n(), dim()));
    det_.at_with_error_quad(c.data(), out.data(), error.data());
    for (std::size_t t = 0; t < size(); ++t)
      EXPECT_LE(error[t], 1e-28 + 0x1p-52 * std::abs(out[t]));
  }
}

TEST_P(Det, ErrorBoundsHoldFarFromTheOrigin) {
  Random random(4);
  Control c = nearly_degenerate(random, 1e-3);
  for (double& x : c) x = 1e3 + 1e-4 * x;
  expect_bounds(c);
}

// Products near the smallest doubles lose all digits, which the bound has to include. Mixed scales:
// large factors multiply cofactors that underflow.
class DetOfLowDegree : public Det {};
TEST_P(DetOfLowDegree, ErrorBoundsHoldUnderUnderflow) {
  Random random(6);
  for (const double scale : {1e-107, 1e-154, 1e-158, 1e-161, 1e-165}) {
    Control c = random_control(random);
    for (double& x : c) x *= scale;
    expect_bounds(c);
    for (std::size_t k = 0; k < c.size(); k += static_cast<std::size_t>(dim())) c[k] *= 1e165;
    expect_bounds(c);
  }
}

template <int K>
void expect_line(const DetCoefficients& det, const Control& c, const Control& d,
                 const std::function<std::vector<double>(const Control&)>& direct,
                 double tolerance) {
  std::vector<StepPolynomial<1>> line;
  for (std::size_t k = 0; k < c.size(); ++k) line.push_back({{c[k], d[k]}});
  std::vector<StepPolynomial<K>> p(static_cast<std::size_t>(det.count()));
  det.along_line(line.data(), p.data());
  for (const double s : {0.0, 0.3, 1.0, -2.0, 17.0}) {
    Control moved = c;
    for (std::size_t k = 0; k < c.size(); ++k) moved[k] += s * d[k];
    const std::vector<double> expected = direct(moved);
    for (std::size_t t = 0; t < p.size(); ++t) {
      double value = 0;
      for (int k = K; k >= 0; --k) value = value * s + p[t].power[k];
      EXPECT_NEAR(value, expected[t], tolerance * (1 + std::pow(std::abs(s), K)));
    }
  }
}

TEST_P(Det, AlongLineIsThePolynomialInTheStep) {
  Random random(5);
  const Control c = random_control(random), d = random_control(random);
  const auto direct = [&](const Control& x) { return at(x); };
  if (dim() == 2)
    expect_line<2>(det_, c, d, direct, 1e-12 * n() * n());
  else
    expect_line<3>(det_, c, d, direct, 1e-12 * n() * n() * n());
}

INSTANTIATE_TEST_SUITE_P(All, Det, testing::ValuesIn(test::all_elements()), test::case_name);
INSTANTIATE_TEST_SUITE_P(UpToTwo, DetOfLowDegree,
                         testing::ValuesIn(test::elements_where([](const auto& c) {
                           return c.degree <= 2;
                         })),
                         test::case_name);

// ---- Triangles. ----

// [MC20] Sec. 5.2 with the factor of method.md E6:
// d_ijk = (n!)^2 / nh! sum_{r+s=ijk} C(i,r1) C(j,r2) C(k,r3) (D0u_r D1v_s - D1u_r D0v_s).
std::vector<Rational> paper_det(int n, const Control& c) {
  const TriangleIndices &ix = TriangleIndices::of_degree(n),
                        &low = TriangleIndices::of_degree(n - 1),
                        &det = TriangleIndices::of_degree(2 * n - 2);
  const auto coordinate = [&](int i, int j, int k, int d) {
    return Rational(c[static_cast<std::size_t>(2 * ix.local(i, j, k) + d)]);
  };
  const auto difference = [&](const MultiIndex& m, int direction, int d) -> Rational {
    const auto [i, j, k] = m;
    return (direction == 0 ? coordinate(i + 1, j, k, d) : coordinate(i, j + 1, k, d)) -
           coordinate(i, j, k + 1, d);
  };
  const auto binomial = [](int a, int b) -> Rational {
    return test::factorial(a) / (test::factorial(b) * test::factorial(a - b));
  };
  const Rational factor = test::factorial(n) * test::factorial(n) / test::factorial(2 * n - 2);
  std::vector<Rational> out;
  for (int t = 0; t < det.count(); ++t) {
    const MultiIndex& m = det.multi(t);
    Rational sum = 0;
    for (int l = 0; l < low.count(); ++l) {
      const MultiIndex& r = low.multi(l);
      const MultiIndex s{m[0] - r[0], m[1] - r[1], m[2] - r[2]};
      if (s[0] < 0 || s[1] < 0 || s[2] < 0) continue;
      sum +=
          binomial(m[0], r[0]) * binomial(m[1], r[1]) * binomial(m[2], r[2]) *
          (difference(r, 0, 0) * difference(s, 1, 1) - difference(r, 1, 0) * difference(s, 0, 1));
    }
    out.push_back(factor * sum);
  }
  return out;
}

TEST(TriangleDet, IsThePapersFormula) {
  Random random(1);
  for (const test::ElementCase& c : test::all_elements()) {
    if (c.name != "triangle") continue;
    const auto space = c.space();
    const DetCoefficients det(space->element());
    Control control;
    for (int k = 0; k < 2 * space->nodes_per_element(); ++k)
      control.push_back(random.integer(-100, 100));
    const test::ExactPolynomial exact = test::exact_det(space->element(), control);
    const std::vector<Rational> paper = paper_det(c.degree, control);
    for (int k = 0; k < det.count(); ++k) {
      const Exponents& e = det.basis().exponents(k);
      EXPECT_EQ(exact.coefficient(e) / test::exact_weight({3}, e),
                paper[static_cast<std::size_t>(k)]);
    }
  }
}

// method.md E13: all control triangles are positive, but det J(1/3, 1/3, 1/3) = -6.62.
TEST(TriangleDet, OneMinorAgreesWithTheTables) {
  Cells face(1, 3);
  face << 0, 1, 2;
  const DetCoefficients affine(BezierTriangleSpace(face, 3, 1).element());
  ASSERT_TRUE(affine.is_one_minor());
  EXPECT_FALSE(DetCoefficients(BezierTriangleSpace(face, 3, 2).element()).is_one_minor());
  Random random(11);
  for (const double size : {1e-160, 1.0, 1e9}) {
    const Vec c = size * random.vector(6), d = random.vector(6);
    double det, error, minor, minor_error;
    affine.at_with_error(c.data(), &det, &error);
    affine.minor_with_error(c.data(), &minor, &minor_error);
    EXPECT_EQ(minor, det);
    EXPECT_EQ(minor_error, error);
    StepPolynomial<1> line[6];
    for (int k = 0; k < 6; ++k) line[k] = {{c[k], d[k]}};
    StepPolynomial<2> along;
    affine.along_line(line, &along);
    const StepPolynomial<2> quick = affine.minor_along_line(line);
    for (int k = 0; k <= 2; ++k) EXPECT_EQ(quick.power[k], along.power[k]);
  }
}

TEST(TriangleDet, PositiveControlTrianglesProveNothing) {
  const double c[] = {1.39, -.22, -.48, .57, .15, .22, 1, -1.67, -1.1, 1.47, 2.07, 1.32};
  Cells face(1, 3);
  face << 0, 1, 2;
  double d[6], error[6];
  DetCoefficients(BezierTriangleSpace(face, 3, 2).element()).at_with_error(c, d, error);
  const Vec b = bernstein_values(2, Barycentric::Constant(1.0 / 3));
  EXPECT_NEAR(b.dot(Eigen::Map<const Vec>(d, 6)), -6.62, 0.005);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
