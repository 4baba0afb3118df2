// Exactness of the elimination x = Z y + c: rank, null space, consistency.
#include "majorant/framework/elimination.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>

#include "majorant/framework/error.h"
#include "random.h"
#include "rational.h"

namespace majorant {
namespace {

using test::Random;
using test::Rational;
using RationalRows = std::vector<std::vector<Rational>>;

struct IntegerSystem {
  Index unknowns;
  std::vector<std::vector<long>> a;
  std::vector<double> b;

  ConstraintRows rows() const {
    ConstraintRows out;
    for (std::size_t r = 0; r < a.size(); ++r) {
      out.begin_row("row " + std::to_string(r));
      for (Index i = 0; i < unknowns; ++i)
        if (const long c = a[r][static_cast<std::size_t>(i)]; c != 0) out.add(i, c);
      out.end_row(b[r]);
    }
    return out;
  }
};

// Returns the rank by rational Gauss elimination by columns; the library uses Gauss-Jordan by rows.
Index exact_rank(const IntegerSystem& s) {
  RationalRows m;
  for (const auto& row : s.a) m.emplace_back(row.begin(), row.end());
  std::size_t rank = 0;
  for (Index c = s.unknowns - 1; c >= 0; --c) {
    const auto k = static_cast<std::size_t>(c);
    std::size_t pivot = rank;
    while (pivot < m.size() && m[pivot][k] == 0) ++pivot;
    if (pivot == m.size()) continue;
    std::swap(m[rank], m[pivot]);
    for (std::size_t r = rank + 1; r < m.size(); ++r) {
      const Rational q = m[r][k] / m[rank][k];
      for (std::size_t i = 0; i < m[r].size(); ++i) m[r][i] -= q * m[rank][i];
    }
    ++rank;
  }
  return static_cast<Index>(rank);
}

// Returns the fraction with denominator <= 5000 whose nearest double is z.
std::optional<Rational> fraction(double z) {
  for (int q = 1; q <= 5000; ++q) {
    const double p = std::round(z * q);
    if (p / q == z) return Rational(static_cast<long>(p), q);
  }
  return std::nullopt;
}

void expect_null_space(const IntegerSystem& s, const Elimination& z) {
  for (std::size_t r = 0; r < s.a.size(); ++r) {
    std::vector<Rational> product(static_cast<std::size_t>(z.reduced_size()));
    for (Index i = 0; i < s.unknowns; ++i)
      for (const auto& e : z.row(i)) {
        const auto c = fraction(e.coefficient);
        ASSERT_TRUE(c.has_value()) << e.coefficient << " is no rounded small fraction";
        product[static_cast<std::size_t>(e.reduced)] += s.a[r][static_cast<std::size_t>(i)] * *c;
      }
    for (const Rational& p : product) EXPECT_EQ(p, 0) << "row " << r;
  }
}

void expect_solves(const IntegerSystem& s, const Vec& x, double tolerance) {
  for (std::size_t r = 0; r < s.a.size(); ++r) {
    double sum = -s.b[r], size = std::abs(s.b[r]) + 1;
    for (Index i = 0; i < s.unknowns; ++i) {
      sum += static_cast<double>(s.a[r][static_cast<std::size_t>(i)]) * x[i];
      size += std::abs(static_cast<double>(s.a[r][static_cast<std::size_t>(i)]) * x[i]);
    }
    EXPECT_LE(std::abs(sum), tolerance * size) << "row " << r;
  }
}

// Returns combinations of fewer independent rows, with right-hand sides of a known solution.
IntegerSystem deficient_system(Random& random, Index unknowns, int independent, int total,
                               int largest) {
  IntegerSystem s{unknowns, {}, {}};
  std::vector<std::vector<long>> basis;
  for (int r = 0; r < independent; ++r) {
    std::vector<long> row(static_cast<std::size_t>(unknowns), 0);
    for (int k = 0; k < 3; ++k)
      row[static_cast<std::size_t>(random.integer(0, unknowns - 1))] =
          random.integer(-largest, largest);
    basis.push_back(row);
  }
  std::vector<double> solution;
  for (Index i = 0; i < unknowns; ++i) solution.push_back(random.integer(-64, 64) / 8.0);
  for (int r = 0; r < total; ++r) {
    std::vector<long> row(static_cast<std::size_t>(unknowns), 0);
    for (const auto& b : basis)
      if (const long c =
              r < independent ? (&b == &basis[static_cast<std::size_t>(r)]) : random.integer(-1, 1);
          c != 0)
        for (std::size_t i = 0; i < row.size(); ++i) row[i] += c * b[i];
    double rhs = 0;
    for (std::size_t i = 0; i < row.size(); ++i) rhs += static_cast<double>(row[i]) * solution[i];
    s.a.push_back(row);
    s.b.push_back(rhs);
  }
  return s;
}

TEST(Elimination, RankAndNullSpaceOfDeficientSystemsAreExact) {
  Random random(7);
  int deficient = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const int independent = random.integer(1, 7);
    const IntegerSystem s = deficient_system(random, random.integer(4, 12), independent,
                                             independent + random.integer(0, 4), trial % 2 ? 1 : 3);
    const Elimination z(s.unknowns, s.rows());
    const Index rank = exact_rank(s);
    deficient += rank < static_cast<Index>(s.a.size());
    ASSERT_EQ(z.rank(), rank) << "trial " << trial;
    ASSERT_EQ(z.full_size(), s.unknowns);
    expect_null_space(s, z);
    Vec x;
    z.expand(random.vector(z.reduced_size(), -10, 10), x);
    expect_solves(s, x, 1e-13);
  }
  EXPECT_GT(deficient, 50);  // enough systems are deficient
}

TEST(Elimination, FreeUnknownsAreUnitRows) {
  Random random(11);
  const IntegerSystem s = deficient_system(random, 10, 5, 8, 2);
  const Elimination z(10, s.rows());
  for (Index j = 0; j < z.reduced_size(); ++j) {
    const Index i = z.full_index(j);
    const Elimination::Row row = z.row(i);
    ASSERT_EQ(row.size(), 1u);
    EXPECT_EQ(row.begin()->reduced, j);
    EXPECT_EQ(row.begin()->coefficient, 1.0);
    EXPECT_EQ(z.offset(i), 0.0);
    EXPECT_LT(j > 0 ? z.full_index(j - 1) : -1, i);
  }
}

TEST(Elimination, WithoutRowsIsTheIdentity) {
  const Elimination z(3, ConstraintRows{});
  EXPECT_EQ(z.rank(), 0);
  Vec x;
  z.expand(Vector3(1, 2, 3), x);
  EXPECT_EQ(x, Vec(Vector3(1, 2, 3)));
  const Elimination nothing(0, ConstraintRows{});
  EXPECT_EQ(nothing.reduced_size(), 0);
  double residual = -1;
  EXPECT_EQ(nothing.reduce(Vec(), &residual).size(), 0);
  EXPECT_EQ(residual, 0.0);
}

TEST(Elimination, PinsGiveBackTheirDoubles) {
  const IntegerSystem s{4, {{0, 1, 0, 0}, {0, 0, 0, -1}}, {0.1, -1.0 / 3.0}};
  const Elimination z(4, s.rows());
  EXPECT_EQ(z.reduced_size(), 2);
  Vec x, dx;
  z.expand(Vector2(5, 6), x);
  EXPECT_EQ(x, Vec(Eigen::Vector4d(5, 0.1, 6, 1.0 / 3.0)));
  z.expand_direction(Vector2(5, 6), dx);
  EXPECT_EQ(dx, Vec(Eigen::Vector4d(5, 0, 6, 0)));
}

TEST(Elimination, AllUnknownsFixed) {
  const IntegerSystem s{2, {{1, 1}, {1, -1}}, {3, 1}};
  const Elimination z(2, s.rows());
  EXPECT_EQ(z.reduced_size(), 0);
  Vec x;
  z.expand(Vec(), x);
  EXPECT_EQ(x, Vec(Vector2(2, 1)));
}

TEST(Elimination, ZeroAndRepeatedCoefficientsOfOneRowAddUp) {
  ConstraintRows rows;
  rows.begin_row("x0 + x0 + 0 x1 - x2 = 4");
  rows.add(0, 1);
  rows.add(1, 0);
  rows.add(0, 1);
  rows.add(2, -1);
  rows.end_row(4);
  const Elimination z(3, rows);
  EXPECT_EQ(z.rank(), 1);
  Vec x;
  z.expand(Vector2(1.5, 7), x);
  EXPECT_EQ(2 * x[0] - x[2], 4.0);
}

// c_i - c_{i+1} = R^k (c'_i - c'_{i+1}) along a cut: one translation is free, coefficients are +-1.
TEST(Elimination, SeamChainsStayUnimodular) {
  constexpr int kPoints = 7;
  const auto unknown = [](int side, int i, int c) { return 2 * (side * kPoints + i) + c; };
  for (int k = 0; k < 4; ++k) {
    const int cosine[] = {1, 0, -1, 0}, sine[] = {0, 1, 0, -1};
    IntegerSystem s{4 * kPoints, {}, {}};
    for (int i = 0; i + 1 < kPoints; ++i)
      for (int c = 0; c < 2; ++c) {
        std::vector<long> row(static_cast<std::size_t>(s.unknowns), 0);
        const auto add = [&](int u, long v) { row[static_cast<std::size_t>(u)] += v; };
        add(unknown(0, i, c), 1);
        add(unknown(0, i + 1, c), -1);
        const long ru = c == 0 ? cosine[k] : sine[k], rv = c == 0 ? -sine[k] : cosine[k];
        add(unknown(1, i, 0), -ru);
        add(unknown(1, i, 1), -rv);
        add(unknown(1, i + 1, 0), ru);
        add(unknown(1, i + 1, 1), rv);
        s.a.push_back(row);
        s.b.push_back(0);
      }
    // The sum of all steps is a dependent row.
    std::vector<long> sum(static_cast<std::size_t>(s.unknowns), 0);
    for (std::size_t r = 0; r < s.a.size(); r += 2)
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += s.a[r][i];
    s.a.push_back(sum);
    s.b.push_back(0);
    const Elimination z(s.unknowns, s.rows());
    EXPECT_EQ(z.rank(), 2 * (kPoints - 1));
    for (Index i = 0; i < s.unknowns; ++i)
      for (const auto& e : z.row(i)) EXPECT_EQ(std::abs(e.coefficient), 1.0);
    expect_null_space(s, z);
  }
}

TEST(Elimination, RedundantRowsWithRoundedTargetsAreAccepted) {
  IntegerSystem s{
      3, {{1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {0.1, 0.2, 0.3}};  // 0.1 + 0.2 != 0.3 in doubles
  ASSERT_NE(s.b[0] + s.b[1], s.b[2]);
  EXPECT_EQ(Elimination(3, s.rows()).rank(), 2);
}

TEST(Elimination, ContradictionsNameTheRow) {
  IntegerSystem s{3, {{1, -1, 0}, {0, 1, -1}, {1, 0, -1}}, {1, 2, 3 + 1e-9}};
  try {
    const Elimination z(3, s.rows());
    FAIL() << "accepted";
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::Unsupported);
    EXPECT_NE(std::string(e.what()).find("'row 2'"), std::string::npos) << e.what();
  }
}

TEST(Elimination, AnEmptyRowWithATargetIsAContradiction) {
  IntegerSystem s{2, {{0, 0}}, {1}};
  EXPECT_THROW(Elimination(2, s.rows()), Error);
  s.b[0] = 0;
  EXPECT_EQ(Elimination(2, s.rows()).rank(), 0);
}

TEST(Elimination, OverflowingCoefficientsThrow) {
  IntegerSystem s{12, {}, {}};
  Random random(3);
  for (int r = 0; r < 11; ++r) {
    s.a.emplace_back();
    for (int i = 0; i < 12; ++i) s.a.back().push_back(random.integer(-2000000000, 2000000000));
    s.b.push_back(0);
  }
  EXPECT_THROW(Elimination(12, s.rows()), Error);
}

TEST(Elimination, UnknownsOutsideTheSystemAreRefused) {
  ConstraintRows rows;
  rows.begin_row("beyond");
  rows.add(99, 1);
  rows.end_row(1);
  EXPECT_ANY_THROW(Elimination(4, rows));
}

TEST(Elimination, ReduceAfterExpandIsTheIdentity) {
  Random random(5);
  const IntegerSystem s = deficient_system(random, 12, 5, 7, 2);
  const Elimination z(12, s.rows());
  const Vec y = random.vector(z.reduced_size());
  Vec x, moved;
  z.expand(y, x);
  double residual = -1;
  EXPECT_EQ(z.reduce(x, &residual), y);
  EXPECT_EQ(residual, 0.0);
  ASSERT_GT(z.rank(), 0);
  Index dependent = 0;
  const auto is_free = [&](Index i) {
    const Elimination::Row row = z.row(i);
    return row.size() == 1 && z.full_index(row.begin()->reduced) == i;
  };
  while (is_free(dependent)) ++dependent;
  moved = x;
  moved[dependent] += 0.5;
  z.reduce(moved, &residual);
  EXPECT_NEAR(residual, 0.5, 1e-14);
}

TEST(Elimination, RestrictIsTheTransposeOfExpand) {
  Random random(9);
  const IntegerSystem s = deficient_system(random, 12, 6, 8, 3);
  const Elimination z(12, s.rows());
  const Vec gx = random.vector(12), dy = random.vector(z.reduced_size());
  Vec gy, dx;
  z.restrict_gradient(gx, gy);
  z.expand_direction(dy, dx);
  EXPECT_NEAR(gy.dot(dy), gx.dot(dx), 1e-13 * gx.norm() * dx.norm());
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
