#include "majorant/elements/exact_determinant.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

#include "elements/valley.h"
#include "majorant/elements/bernstein_space.h"
#include "majorant/framework/error.h"

namespace majorant {
namespace {

Points2 flat_triangle(int degree, const Vector2& a, const Vector2& b, const Vector2& c) {
  const TriangleIndices& ix = TriangleIndices::of_degree(degree);
  Points2 points(ix.count(), 2);
  for (int l = 0; l < ix.count(); ++l)
    points.row(l) =
        (ix.multi(l)[0] * a + ix.multi(l)[1] * b + ix.multi(l)[2] * c).transpose() / degree;
  return points;
}

// Returns det J at a point in long double, as reference where it is not close to 0.
long double det(const Points2& points, const Barycentric& xi) {
  const int degree = degree_from_control_points(static_cast<int>(points.rows()));
  const Eigen::MatrixX2d g = bernstein_gradients(degree, xi);
  Eigen::Matrix<long double, 2, 2> j = Eigen::Matrix<long double, 2, 2>::Zero();
  for (Index k = 0; k < g.rows(); ++k)
    j += points.row(k).transpose().cast<long double>() * g.row(k).cast<long double>();
  return j.determinant();
}

TEST(ExactDeterminant, TrianglesDownToTheLastBit) {
  for (const double scale : {1.0, 0x1p-500, 0x1p500}) {
    const Vector2 a(0, 0), b(3 * scale, 1 * scale);
    // c = (7, 7/3): its distance from the line is the rounding of 7/3
    const double y = 7 * scale / 3;
    for (int ulps = -2; ulps <= 2; ++ulps) {
      double moved = y;
      for (int k = 0; k < std::abs(ulps); ++k) moved = std::nextafter(moved, ulps * INFINITY);
      const Vector2 c(7 * scale, moved);
      const ProofStatus result = exact_determinant_of_triangle(flat_triangle(1, a, b, c)).positive;
      // 3 y > 7 exactly: 3 * fl(7/3) in 106 bits.
      const bool is_left = std::fma(3.0, moved / scale, -7.0) > 0;
      EXPECT_EQ(result == ProofStatus::Proven, is_left) << ulps;
      EXPECT_EQ(result == ProofStatus::Violated, !is_left) << ulps;
    }
    EXPECT_EQ(exact_determinant_of_triangle(flat_triangle(1, a, b, 2 * b)).positive,
              ProofStatus::Violated);
  }
  // The square of the smallest doubles underflows.
  const double tiny = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(exact_determinant_of_triangle(flat_triangle(1, {0, 0}, {tiny, 0}, {0, tiny})).positive,
            ProofStatus::Proven);
  EXPECT_EQ(exact_determinant_of_triangle(flat_triangle(1, {0, 0}, {0, tiny}, {tiny, 0})).positive,
            ProofStatus::Violated);
}

TEST(ExactDeterminant, AgreesWithTheFloatingPointProof) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int certified = 0, violated = 0;
  for (int degree = 1; degree <= 8; ++degree)
    for (int trial = 0; trial < 40; ++trial) {
      Points2 points = flat_triangle(degree, {0, 0}, {1, 0}, {0, 1});
      for (double& value : points.reshaped()) value += 0.6 / degree * uniform(random);
      const DeterminantRange exact = exact_determinant_of_triangle(points);
      Cells face(1, 3);
      face << 0, 1, 2;
      const BezierTriangleSpace space(face, 3, degree);
      Vec x(2 * space.node_count());
      for (Index k = 0; k < points.rows(); ++k)
        x.segment<2>(2 * space.cells()(0, k)) = points.row(k);
      const PositivityProof proof = space.certify(0, x, 16);
      if (proof.result == ProofStatus::Proven) {
        EXPECT_EQ(exact.positive, ProofStatus::Proven);
      }
      if (exact.positive == ProofStatus::Violated) {
        EXPECT_LT(det(points, {exact.at[0], exact.at[1], exact.at[2]}), 1e-14L);
        EXPECT_NE(proof.result, ProofStatus::Proven);
      }
      certified += exact.positive == ProofStatus::Proven;
      violated += exact.positive == ProofStatus::Violated;
    }
  EXPECT_GT(certified, 60);
  EXPECT_GT(violated, 30);
}

using test::valley;

TEST(ExactDeterminant, Valleys) {
  for (const double e : {0.125, 0x1p-20, 0x1p-40}) {
    EXPECT_EQ(exact_determinant_of_triangle(valley(0.375, e)).positive, ProofStatus::Proven) << e;
    EXPECT_EQ(exact_determinant_of_triangle(valley(0.375, -e)).positive, ProofStatus::Violated)
        << e;
  }
  const DeterminantRange zero = exact_determinant_of_triangle(valley(0.5, 0));
  EXPECT_EQ(zero.positive, ProofStatus::Violated);  // bisection meets u = 1/2
  EXPECT_EQ(zero.at[1], 0.5);
  // u = 1/3 is not dyadic: bisection neither meets it nor proves the sign, but terminates.
  EXPECT_EQ(exact_determinant_of_triangle(valley(1.0 / 3, 0)).positive == ProofStatus::Proven,
            false);
}

TEST(ExactDeterminant, CoordinatesBeyondDoublesAreUndecided) {
  for (const double beyond : {INFINITY, -INFINITY, NAN}) {
    Points2 points = valley(0.375, 0.01);
    ASSERT_EQ(exact_determinant_of_triangle(points).positive, ProofStatus::Proven);
    points(1, 0) = beyond;
    EXPECT_EQ(exact_determinant_of_triangle(points).positive, ProofStatus::Undecided) << beyond;
  }
}

TEST(ExactDeterminant, RefusesOtherCounts) {
  EXPECT_THROW(exact_determinant_of_triangle(Points2::Zero(5, 2)), InvalidArgument);
  EXPECT_THROW(exact_determinant_of_triangle(Points2::Zero(1, 2)), InvalidArgument);
  EXPECT_THROW(exact_determinant_of_triangle(Points2::Zero(55, 2)), InvalidArgument);  // degree 9
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
