// Certificates of positivity: never wrong, and strong enough to be useful.
#include "majorant/elements/positivity.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>

#include "exact_polynomials.h"
#include "majorant/elements/bernstein_space.h"
#include "majorant/elements/det_coefficients.h"
#include "support.h"

namespace majorant {
namespace {

using test::Random;
using test::Rational;

Cells one_face() {
  Cells f(1, 3);
  f << 0, 1, 2;
  return f;
}

// Returns the bisection of polynomials of degree n on triangles.
const Subdivision& triangle(int n) {
  static std::map<int, Subdivision> all;
  const BernsteinElement element = BezierTriangleSpace(one_face(), 3, 1).element();
  return all.try_emplace(n, element.basis({n}), element.bisections).first->second;
}

// Returns the exact minimum over the points of a lattice (an upper bound of the minimum).
Rational sampled_minimum(int n, const std::vector<double>& c, int m) {
  const std::vector<Rational> q = test::exact(c.data(), static_cast<int>(c.size()));
  Rational lowest = q[0];
  for (int i = 0; i <= m; ++i)
    for (int j = 0; j <= m - i; ++j)
      lowest = std::min(
          lowest, test::evaluate(n, q, {Rational(i, m), Rational(j, m), Rational(m - i - j, m)}));
  return lowest;
}

TEST(CertifyPositive, IsNeverWrongOnRandomPolynomials) {
  Random random(1);
  int certified = 0, bisected = 0, refused = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const int n = random.integer(0, 5);
    std::vector<double> c(static_cast<std::size_t>(control_point_count(n)));
    for (double& x : c) x = random.uniform(-0.45, 1);
    for (std::size_t k = 0; k < std::min<std::size_t>(3, c.size()); ++k) c[k] = std::abs(c[k]);
    const Rational lowest = sampled_minimum(n, c, 12);
    const PositivityProof proof = certify_positive(triangle(n), c.data(), 0, 6);
    EXPECT_LE(Rational(proof.lower_bound), lowest);
    if (proof.result != ProofStatus::Proven) {
      ++refused;
      continue;
    }
    ++certified;
    bisected += proof.depth > 0;
    EXPECT_GT(proof.lower_bound, 0);
    EXPECT_GT(lowest, 0) << "degree " << n;
  }
  EXPECT_GT(certified, 50);
  EXPECT_GT(bisected, 30);
  EXPECT_GT(refused, 10);
}

// Convergence of the bound: the quadratic (x0 - x1)^2 + shift and its rotations.
TEST(CertifyPositive, ProvesPolynomialsThatNeedBisection) {
  for (int rotation = 0; rotation < 3; ++rotation) {
    std::vector<double> c(6);
    const int order[3][6] = {{0, 1, 2, 3, 4, 5}, {1, 2, 0, 4, 5, 3}, {2, 0, 1, 5, 3, 4}};
    const double values[6] = {1, 1, 0, -1, 0, 0};  // (x0 - x1)^2
    for (int k = 0; k < 6; ++k) c[static_cast<std::size_t>(order[rotation][k])] = values[k] + 0.05;
    EXPECT_EQ(certify_positive(triangle(2), c.data(), 0, 0).result, ProofStatus::Undecided);
    const PositivityProof proof = certify_positive(triangle(2), c.data(), 0, 8);
    EXPECT_EQ(proof.result, ProofStatus::Proven);
    EXPECT_GT(proof.depth, 0);
    EXPECT_LE(proof.lower_bound, 0.05);
    EXPECT_EQ(certify_positive(triangle(2), c.data(), 0, proof.depth).result, ProofStatus::Proven);
    EXPECT_EQ(certify_positive(triangle(2), c.data(), 0, proof.depth - 1).result,
              ProofStatus::Undecided);
    EXPECT_NE(certify_positive(triangle(2), c.data(), 0.051, 8).result, ProofStatus::Proven);
  }
}

TEST(CertifyPositive, TouchingZeroIsNotPositive) {
  const double touching[6] = {1, 1, 1, -1, 0, 0};  // zero at the midpoint of edge 01
  for (int depth = 0; depth < 12; ++depth)
    EXPECT_NE(certify_positive(triangle(2), touching, 0, depth).result, ProofStatus::Proven);
  const double corner[3] = {1, 0, 1}, negative[3] = {1, 1, -1e-300}, zero[1] = {0};
  EXPECT_EQ(certify_positive(triangle(1), corner, 0, 5).result, ProofStatus::Violated);
  EXPECT_EQ(certify_positive(triangle(1), negative, 0, 5).result, ProofStatus::Violated);
  EXPECT_EQ(certify_positive(triangle(0), zero, 0, 5).result, ProofStatus::Violated);
  const double tiny[1] = {1e-300};
  EXPECT_EQ(certify_positive(triangle(0), tiny, 0, 0).result, ProofStatus::Proven);
  EXPECT_EQ(certify_positive(triangle(0), tiny, 1e-299, 5).result, ProofStatus::Violated);
}

// Halves of the smallest doubles are rounded, up and down.
TEST(CertifyPositive, BoundsHoldForTheSmallestDoubles) {
  constexpr int kDegree = 6;
  constexpr double kSmallest = std::numeric_limits<double>::denorm_min();
  Random random(3);
  int bisected = 0;
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<double> c(static_cast<std::size_t>(control_point_count(kDegree)), 90);
    for (const int k : TriangleIndices::of_degree(kDegree).edge(0))
      c[static_cast<std::size_t>(k)] = random.integer(-9, 90);
    const Rational lowest = sampled_minimum(kDegree, c, 8);
    for (double& x : c) x *= kSmallest;
    const PositivityProof proof = certify_positive(triangle(kDegree), c.data(), 0, 8);
    EXPECT_LE(Rational(proof.lower_bound / kSmallest), lowest) << "trial " << trial;
    bisected += proof.result == ProofStatus::Proven && proof.depth > 0;
  }
  EXPECT_GT(bisected, 10);
}

// method.md N5: NaN at any position must count as failure.
TEST(CertifyPositive, NaNIsNeverCertified) {
  for (const double bad : {std::nan(""), -std::nan(""), -std::numeric_limits<double>::infinity()})
    for (std::size_t k = 0; k < 6; ++k) {
      std::vector<double> c(6, 1.0);
      c[k] = bad;
      EXPECT_NE(certify_positive(triangle(2), c.data(), 0, 3).result, ProofStatus::Proven)
          << "at " << k;
    }
  const std::vector<double> fine(6, 1.0);
  EXPECT_NE(certify_positive(triangle(2), fine.data(), std::nan(""), 3).result,
            ProofStatus::Proven);
}

TEST(Certify, MapsWithNonfiniteControlPointsAreNotCertified) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (int n = 1; n <= 4; ++n) {
    const BezierTriangleSpace space(one_face(), 3, n);
    Points2 corners(3, 2);
    corners << 1, 0, 0, 1, 0, 0;
    const Vec x = test::linear_map(space, corners);
    ASSERT_EQ(space.certify(0, x, 5).result, ProofStatus::Proven);
    for (const double bad : {std::nan(""), infinity, -infinity})
      for (Index k = 0; k < x.size(); ++k) {
        Vec broken = x;
        broken[k] = bad;
        EXPECT_NE(space.certify(0, broken, 5).result, ProofStatus::Proven)
            << "degree " << n << ", unknown " << k << " = " << bad;
      }
  }
}

// Triangles of relative area 1e-15 and below, whose sign doubles do not determine: certified ones
// must be positive in exact arithmetic.
TEST(Certify, NearlyDegenerateTrianglesAgreeWithExactArithmetic) {
  Random random(2);
  const BezierTriangleSpace space(one_face(), 3, 1);
  int positive = 0;
  for (int trial = 0; trial < 300; ++trial) {
    Vec x = random.vector(6);
    const double t = random.uniform();
    x[4] = x[0] + t * (x[2] - x[0]);
    x[5] = x[1] + t * (x[3] - x[1]);  // on the edge up to rounding
    const std::vector<Rational> q = test::exact(x.data(), 6);
    const Rational det = (q[0] - q[4]) * (q[3] - q[5]) - (q[1] - q[5]) * (q[2] - q[4]);
    const PositivityProof proof = space.certify(0, x, 5);
    EXPECT_EQ(proof.result == ProofStatus::Proven, det > 0);
    positive += det > 0;
  }
  EXPECT_GT(positive, 50);
  EXPECT_LT(positive, 250);
}

using Line = std::vector<StepPolynomial<2>>;

// Returns a random line of maps of degree m that starts at the identity.
Line random_line(Random& random, int m, double amplitude) {
  const BezierTriangleSpace space(one_face(), 3, m);
  const DetCoefficients det(space.element());
  const TriangleIndices& ix = TriangleIndices::of_degree(m);
  std::vector<StepPolynomial<1>> c;
  for (int l = 0; l < ix.count(); ++l)
    for (std::size_t k = 0; k < 2; ++k) {
      const double x = ix.multi(l)[k] / double(m) + 0.3 * random.uniform() / m / m;
      c.push_back({{x, amplitude * random.uniform()}});
    }
  Line line(static_cast<std::size_t>(det.count()));
  det.along_line(c.data(), line.data());
  return line;
}

std::vector<double> start_of(const Line& line) {
  std::vector<double> out;
  for (const StepPolynomial<2>& p : line) out.push_back(p.power[0]);
  return out;
}

// Returns the smallest value at parameter t on a dense lattice.
double minimum_at(int n, const Line& line, double t) {
  Vec c(static_cast<Index>(line.size()));
  for (Index k = 0; k < c.size(); ++k) {
    const auto [p, q, r] = line[static_cast<std::size_t>(k)].power;
    c[k] = p + t * q + t * t * r;
  }
  double lowest = c[0];
  constexpr int kFine = 24;
  for (int i = 0; i <= kFine; ++i)
    for (int j = 0; j <= kFine - i; ++j)
      lowest =
          std::min(lowest, bernstein_values(n, Barycentric(i, j, kFine - i - j) / kFine).dot(c));
  return lowest;
}

double step_of(int n, const Line& line, double s, int depth) {
  return largest_positive_step(triangle(n), line.data(), s, depth);
}

class LargestStep : public testing::TestWithParam<int> {};

TEST_P(LargestStep, IsPositiveBeforeAndTightWithBisection) {
  const int m = GetParam(), n = 2 * (m - 1);
  Random random(static_cast<unsigned>(m));
  int limited = 0, improved = 0;
  for (int trial = 0; trial < (m == 1 ? 60 : 12); ++trial) {
    const Line line = random_line(random, m, 1.0);
    if (certify_positive(triangle(n), start_of(line).data(), 0, 8).result != ProofStatus::Proven)
      continue;
    const double quick = step_of(n, line, 1, 0), step = step_of(n, line, 1, 8);
    EXPECT_GE(step, quick);
    EXPECT_GT(step, 0);
    EXPECT_LE(step, 1);
    improved += step > quick;
    for (int k = 0; k < 20; ++k)
      EXPECT_GT(minimum_at(n, line, step * k / 20.0), 0) << "t = " << step * k / 20.0;
    if (step == 1) continue;
    ++limited;
    // Slightly beyond, the polynomial nearly has a zero: the bound is not too small.
    EXPECT_LT(minimum_at(n, line, std::min(1.0, 1.05 * step)), 0.02);
  }
  EXPECT_GT(limited, 3);
  EXPECT_TRUE(m == 1 || improved > 0);
}

INSTANTIATE_TEST_SUITE_P(Degrees, LargestStep, testing::Range(1, 6));

TEST(LargestStep, ExactRoots) {
  const auto step = [](double a, double b, double c, double s) {
    const StepPolynomial<2> p{{a, b, c}};
    return largest_positive_step(triangle(0), &p, s, 4);
  };
  EXPECT_EQ(step(1, 0, 0, 3), 3);
  EXPECT_DOUBLE_EQ(step(1, -2, 0, 3), 0.5);
  EXPECT_DOUBLE_EQ(step(2, 0, -8, 3), 0.5);  // root from the quadratic term alone
  EXPECT_DOUBLE_EQ(step(6, -5, 1, 10), 2);   // the smaller of 2 and 3
  EXPECT_EQ(step(6, -5, 1, 1.5), 1.5);
  EXPECT_EQ(step(1, -1, 1, 10), 10);                // no real root
  EXPECT_EQ(step(6, 5, 1, 10), 10);                 // both roots negative
  EXPECT_DOUBLE_EQ(step(1, -2, 1, 10), 1);          // a double root is a zero
  EXPECT_DOUBLE_EQ(step(1e-30, -1, 1, 10), 1e-30);  // no cancellation
  EXPECT_DOUBLE_EQ(step(1, 1, -1e-20, 1e30), 1e20);
  EXPECT_DOUBLE_EQ(step(1e-18, 1, -1, 10), 1);  // a triangle of relative area 1e-18
  EXPECT_DOUBLE_EQ(step(1e-13, 1, -1, 10), 1 + 1e-13);
  EXPECT_EQ(step(0, 1, 1, 10), 0);
  EXPECT_EQ(step(-1, 5, 0, 10), 0);
  EXPECT_EQ(step(std::nan(""), 0, 0, 1), 0);
  EXPECT_EQ(step(1, std::nan(""), 0, 1), 0);
  EXPECT_EQ(step(1, 0, std::nan(""), 1), 0);
}

// Coefficients that are not all positive at s = 0 although the polynomial is: bisection has to find
// a positive step.
TEST(LargestStep, StartsThatOnlyBisectionCertifies) {
  Line line(6, StepPolynomial<2>{{1, -1, 0}});
  line[3] = {{-0.5, 0, 0}};
  EXPECT_EQ(step_of(2, line, 1, 0), 0);
  const double step = step_of(2, line, 1, 8);
  EXPECT_GT(step, 0.4);  // on edge 01 the minimum is (1 - t - 0.5) / 2
  EXPECT_LE(step, 0.5);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
