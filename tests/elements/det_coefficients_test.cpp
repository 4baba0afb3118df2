// Bernstein coefficients of det J against exact rational arithmetic, and their error bounds.
#include "majorant/elements/det_coefficients.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "support.h"

namespace majorant {
namespace {

using test::Random;
using test::Rational;
using Control = std::vector<double>;  // 2 numbers per control point

int count_of(int n) { return 2 * control_point_count(n); }

// [MC20] Sec. 5.2 with the factor of method.md E6:
// d_ijk = (n!)^2 / nh! sum_{r+s=ijk} C(i,r1) C(j,r2) C(k,r3) (D0u_r D1v_s - D1u_r D0v_s).
std::vector<Rational> exact_det(int n, const Control& c) {
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

// The same polynomial pointwise: derivative of the map in direction a, by barycentric differences.
Rational exact_det_at(int n, const Control& c, const test::ExactPoint& p) {
  const TriangleIndices &ix = TriangleIndices::of_degree(n),
                        &low = TriangleIndices::of_degree(n - 1);
  Rational d[2][2];
  for (int direction = 0; direction < 2; ++direction)
    for (int x = 0; x < 2; ++x) {
      std::vector<Rational> derivative;
      for (int l = 0; l < low.count(); ++l) {
        const auto [i, j, k] = low.multi(l);
        const auto at = [&](int local) {
          return Rational(c[static_cast<std::size_t>(2 * local + x)]);
        };
        derivative.push_back(n *
                             (at(direction == 0 ? ix.local(i + 1, j, k) : ix.local(i, j + 1, k)) -
                              at(ix.local(i, j, k + 1))));
      }
      d[direction][x] = test::evaluate(n - 1, derivative, p);
    }
  return d[0][0] * d[1][1] - d[1][0] * d[0][1];
}

Control random_control(Random& random, int n) {
  Control c;
  for (int k = 0; k < count_of(n); ++k) c.push_back(random.uniform());
  return c;
}

// All control points nearly on one line, so that every coefficient cancels almost completely.
Control nearly_degenerate(Random& random, int n, double height) {
  Control c;
  for (int k = 0; k < control_point_count(n); ++k) {
    const double t = random.uniform(-3, 3);
    c.push_back(t);
    c.push_back(t / 3 + height * random.uniform());
  }
  return c;
}

class Det : public testing::TestWithParam<int> {
 protected:
  int n() const { return GetParam(); }
  const DetCoefficients& det() const { return DetCoefficients::of_degree(n()); }
  std::size_t size() const { return static_cast<std::size_t>(det().count()); }
};

TEST_P(Det, FormulaIsTheDeterminant) {
  Random random(1);
  const Control c = random_control(random, n());
  const std::vector<Rational> d = exact_det(n(), c);
  ASSERT_EQ(d.size(), size());
  for (int trial = 0; trial < 4; ++trial) {
    const auto p = test::exact_point(random);
    EXPECT_EQ(test::evaluate(det().det_degree(), d, p), exact_det_at(n(), c, p));
  }
}

TEST_P(Det, CoefficientsAreExactOnSmallIntegers) {
  Random random(2);
  Control c;
  for (int k = 0; k < count_of(n()); ++k) c.push_back(random.integer(-8, 8));
  std::vector<double> out(size());
  det().at(c.data(), out.data());
  const std::vector<Rational> expected = exact_det(n(), c);
  for (std::size_t t = 0; t < size(); ++t)
    EXPECT_NEAR(out[t], static_cast<double>(expected[t]), 1e-12 * n() * n() * 100);
}

TEST_P(Det, IdentityHasConstantOne) {
  const TriangleIndices& ix = TriangleIndices::of_degree(n());
  Control c;
  for (int l = 0; l < ix.count(); ++l)
    for (std::size_t x = 0; x < 2; ++x) c.push_back(ix.multi(l)[x] / double(n()));
  std::vector<double> out(size());
  det().at(c.data(), out.data());
  for (const double d : out) EXPECT_NEAR(d, 1, 1e-13);
}

void expect_bounds(const std::vector<Rational>& expected, const std::vector<double>& out,
                   const std::vector<double>& error, const char* what) {
  for (std::size_t t = 0; t < out.size(); ++t) {
    const Rational off = abs(expected[t] - Rational(out[t]));
    EXPECT_TRUE(off <= Rational(error[t]))
        << what << ", coefficient " << t << ": off by " << static_cast<double>(off) << ", claimed "
        << error[t] << ", value " << out[t];
  }
}

TEST_P(Det, ErrorBoundsHold) {
  Random random(3);
  std::vector<double> out(size()), error(size());
  for (int trial = 0; trial < 12; ++trial) {
    const double height = std::pow(10.0, -1.4 * trial);
    const Control c =
        trial == 0 ? random_control(random, n()) : nearly_degenerate(random, n(), height);
    const std::vector<Rational> expected = exact_det(n(), c);
    det().at_with_error(c.data(), out.data(), error.data());
    expect_bounds(expected, out, error, "double");
    const double coarse = *std::max_element(error.begin(), error.end());
    EXPECT_LE(coarse, 1e-12 * n() * n());
    det().at_with_error_quad(c.data(), out.data(), error.data());
    expect_bounds(expected, out, error, "quadruple");
    EXPECT_LE(*std::max_element(error.begin(), error.end()), coarse);
  }
}

TEST_P(Det, ErrorBoundsHoldFarFromTheOrigin) {
  Random random(4);
  std::vector<double> out(size()), error(size());
  Control c = nearly_degenerate(random, n(), 1e-3);
  for (std::size_t k = 0; k < c.size(); ++k) c[k] = 1e3 + 1e-4 * c[k];
  det().at_with_error(c.data(), out.data(), error.data());
  expect_bounds(exact_det(n(), c), out, error, "double");
  det().at_with_error_quad(c.data(), out.data(), error.data());
  expect_bounds(exact_det(n(), c), out, error, "quadruple");
}

TEST_P(Det, AlongLineIsTheQuadraticInTheStep) {
  Random random(5);
  const Control c = random_control(random, n()), d = random_control(random, n());
  std::vector<double> p0(size()), p1(size()), p2(size()), direct(size());
  det().along_line(c.data(), d.data(), p0.data(), p1.data(), p2.data());
  for (const double s : {0.0, 0.3, 1.0, -2.0, 17.0}) {
    Control moved = c;
    for (std::size_t k = 0; k < c.size(); ++k) moved[k] += s * d[k];
    det().at(moved.data(), direct.data());
    for (std::size_t t = 0; t < size(); ++t)
      EXPECT_NEAR(p0[t] + s * p1[t] + s * s * p2[t], direct[t], 1e-12 * n() * n() * (1 + s * s));
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees, Det, testing::Range(1, DetCoefficients::kMaxDegree + 1));

TEST(DetDegrees, OthersAreRefused) {
  EXPECT_THROW(DetCoefficients::of_degree(0), std::out_of_range);
  EXPECT_THROW(DetCoefficients::of_degree(9), std::out_of_range);
}

// method.md E13: all control triangles positive, yet det J(1/3, 1/3, 1/3) = -6.62.
TEST(DetExamples, PositiveControlTrianglesProveNothing) {
  const double c[] = {1.39, -.22, -.48, .57, .15, .22, 1, -1.67, -1.1, 1.47, 2.07, 1.32};
  double d[6];
  DetCoefficients::of_degree(2).at(c, d);
  const Vec b = bernstein_values(2, Barycentric::Constant(1.0 / 3));
  EXPECT_NEAR(b.dot(Eigen::Map<const Vec>(d, 6)), -6.62, 0.005);
}

// Products near the smallest doubles lose all digits; the bound must say so.
TEST(DetExamples, ErrorBoundsHoldUnderUnderflow) {
  Random random(6);
  const DetCoefficients& det = DetCoefficients::of_degree(2);
  for (const double scale : {1e-154, 1e-158, 1e-161, 1e-165}) {
    Control c = random_control(random, 2);
    for (double& x : c) x *= scale;
    std::vector<double> out(6), error(6);
    det.at_with_error(c.data(), out.data(), error.data());
    expect_bounds(exact_det(2, c), out, error, "double");
    det.at_with_error_quad(c.data(), out.data(), error.data());
    expect_bounds(exact_det(2, c), out, error, "quadruple");
  }
}

}  // namespace
}  // namespace majorant
