// Rows with real coefficients: rank by a documented rule, null space, agreement with dense SVD,
// messages for rows that contradict or nearly repeat others. Integer rows beside them stay exact.
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <Eigen/SVD>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "expected_error.h"
#include "majorant/framework/elimination.h"
#include "majorant/framework/error.h"
#include "majorant/framework/internal/affine_presolve.h"
#include "random.h"

namespace majorant {
namespace {

using test::Random;

ConstraintRows rows_of(const Eigen::MatrixXd& a, const Vec& b) {
  ConstraintRows rows;
  for (Index r = 0; r < a.rows(); ++r) {
    rows.begin_row("row " + std::to_string(r));
    for (Index i = 0; i < a.cols(); ++i)
      if (a(r, i) != 0) rows.add(i, a(r, i));
    rows.end_row(b[r]);
  }
  return rows;
}

Eigen::MatrixXd null_space(const Elimination& z) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(z.full_size(), z.reduced_size());
  for (Index i = 0; i < z.full_size(); ++i)
    for (const auto& e : z.row(i)) out(i, e.reduced) = e.coefficient;
  return out;
}

Eigen::MatrixXd random_matrix(Random& random, Index rows, Index columns) {
  Eigen::MatrixXd a(rows, columns);
  for (Index r = 0; r < rows; ++r)
    for (Index c = 0; c < columns; ++c) a(r, c) = random.uniform();
  return a;
}

// Expects equal spaces: projectors agree, up to the condition of the rows.
void expect_same_space(Eigen::MatrixXd a, const Elimination& z) {
  a.rowwise().normalize();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(a, Eigen::ComputeFullV);
  const double condition = svd.singularValues()[0] / svd.singularValues()[z.rank() - 1];
  const Eigen::MatrixXd kernel = svd.matrixV().rightCols(z.reduced_size());
  const Eigen::MatrixXd q = Eigen::HouseholderQR<Eigen::MatrixXd>(null_space(z)).householderQ() *
                            Eigen::MatrixXd::Identity(z.full_size(), z.reduced_size());
  EXPECT_LT((kernel * kernel.transpose() - q * q.transpose()).norm(), 1e-13 * condition);
}

TEST(RealRows, RankAndNullSpaceAreThoseOfADenseSvd) {
  Random random(21);
  for (int trial = 0; trial < 200; ++trial) {
    const Index unknowns = random.integer(3, 30), rank = random.integer(1, unknowns - 1);
    const Index count = rank + random.integer(0, 5);
    Eigen::MatrixXd a = random_matrix(random, count, rank) * random_matrix(random, rank, unknowns);
    // Rows have different units, and every third row is sparse.
    for (Index r = 0; r < count; ++r) a.row(r) *= std::pow(10.0, random.integer(-6, 6));
    const Vec x0 = random.vector(unknowns);
    const Elimination z(unknowns, rows_of(a, a * x0));
    ASSERT_EQ(z.rank(), rank) << "trial " << trial;
    expect_same_space(a, z);
    Vec x;
    z.expand(random.vector(z.reduced_size()), x);
    for (Index r = 0; r < count; ++r)
      EXPECT_LE(std::abs(a.row(r).dot(x - x0)), 1e-9 * a.row(r).norm() * (1 + x.norm()))
          << "trial " << trial << ", row " << r;
  }
}

TEST(RealRows, ClosedForm) {
  ConstraintRows rows;  // a point on a line at 30 degrees through the origin
  rows.begin_row("on the line");
  rows.add(0, 0.5);
  rows.add(1, -std::sqrt(3) / 2);
  rows.end_row(0);
  const Elimination z(2, rows);
  ASSERT_EQ(z.reduced_size(), 1);
  Vec x;
  z.expand(Vec::Constant(1, 0.7), x);
  EXPECT_NEAR(x[1] / x[0], 1 / std::sqrt(3), 1e-15);
}

// A reflection has rank 1 on the points of its axis: one of two rows follows from the other.
TEST(RealRows, RowsThatFollowAreRecognized) {
  for (int k = 1; k < 90; ++k) {
    const double c = std::cos(2 * k * std::numbers::pi / 180),
                 s = std::sin(2 * k * std::numbers::pi / 180);
    Eigen::MatrixXd a(2, 2);
    a << 1 - c, -s, -s, 1 + c;
    EXPECT_EQ(Elimination(2, rows_of(a, Vector2::Zero())).rank(), 1) << k;
  }
}

TEST(RealRows, IntegersBesideThemStayExact) {
  const auto add = [](ConstraintRows& rows, int k) {
    rows.begin_row("integer " + std::to_string(k));
    rows.add(k, 3);
    rows.add(k + 1, -7);
    rows.end_row(1);
  };
  ConstraintRows integers, both;
  for (int k = 0; k < 4; ++k) add(integers, k);
  for (int k = 0; k < 2; ++k) add(both, k);
  both.begin_row("real, of other unknowns");
  both.add(6, 0.1);
  both.add(7, 0.3);
  both.end_row(0);
  for (int k = 2; k < 4; ++k) add(both, k);
  const Elimination a(8, integers), b(8, both);
  for (Index i = 0; i < 6; ++i) {
    ASSERT_EQ(a.row(i).size(), b.row(i).size());
    EXPECT_EQ(a.row(i).begin()->coefficient, b.row(i).begin()->coefficient);
    EXPECT_EQ(a.offset(i), b.offset(i));
  }
  EXPECT_EQ(a.rank() + 1, b.rank());
  EXPECT_EQ(b.row(0).begin()->coefficient, 2401.0 / 81);  // (7/3)^4, rounded once
}

// The order does not matter: a preceding real row does not change the result of integer rows.
TEST(RealRows, RealRowsComeLast) {
  for (const bool first : {true, false}) {
    ConstraintRows rows;
    const auto real = [&] {
      rows.begin_row("real");
      rows.add(0, 0.25);
      rows.add(1, 0.5);
      rows.end_row(1);
    };
    if (first) real();
    rows.begin_row("integer");
    rows.add(0, 1);
    rows.end_row(2);
    if (!first) real();
    const Elimination z(2, rows);
    EXPECT_EQ(z.reduced_size(), 0);
    EXPECT_EQ(z.offset(0), 2);
    EXPECT_EQ(z.offset(1), 1);
  }
}

TEST(RealRows, ContradictionsAreNamed) {
  ConstraintRows rows;
  for (const double target : {1.0, 1.0 + 1e-6}) {
    rows.begin_row(target == 1 ? "first" : "second");
    rows.add(0, 0.1);
    rows.add(1, 0.2);
    rows.end_row(target);
  }
  expect_contains(error_message(ErrorKind::Unsupported, [&] { Elimination(3, rows); }),
                  {"row 'second' is off"});
}

TEST(RealRows, RowsThatNearlyFollowAreNamedWithThoseBefore) {
  const auto with = [](double change) {
    ConstraintRows rows;
    for (const double d : {0.0, change}) {
      rows.begin_row(d == 0 ? "first" : "second");
      rows.add(0, 0.1);
      rows.add(1, 0.2 + d);
      rows.end_row(1);
    }
    return rows;
  };
  EXPECT_EQ(Elimination(2, with(0)).rank(), 1);
  EXPECT_EQ(Elimination(2, with(1e-15)).rank(), 1);
  EXPECT_EQ(Elimination(2, with(1e-7)).rank(), 2);
  expect_contains(error_message(ErrorKind::Unsupported, [&] { Elimination(2, with(1e-10)); }),
                  {"row 'second' nearly follows from rows before it: 'first'"});
}

TEST(RealRows, CoefficientsMustBeFinite) {
  for (const double bad : {std::numeric_limits<double>::infinity(), std::nan("")}) {
    ConstraintRows rows;
    rows.begin_row("bad");
    rows.add(0, bad);
    rows.end_row(0);
    EXPECT_THROW(Elimination(1, rows), Error);
  }
}

// An auxiliary unknown with a real coefficient: x0 = 0.3 t, x1 = 0.5 t.
TEST(RealRows, AuxiliaryUnknowns) {
  ConstraintRows rows;
  const Index t = rows.add_auxiliary();
  for (const Index i : {0, 1}) {
    rows.begin_row("on a ray");
    rows.add(i, 1);
    rows.add(t, i == 0 ? -0.3 : -0.5);
    rows.end_row(0);
  }
  const Elimination z(2, rows);
  ASSERT_EQ(z.reduced_size(), 1);
  double residual = 1;
  const Vec y = z.reduce(Vector2(0.6, 1.0), &residual);
  EXPECT_LT(residual, 1e-15);
  Vec x;
  z.expand(3 * y, x);
  EXPECT_NEAR((x - Vector2(1.8, 3.0)).norm(), 0, 1e-14);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
