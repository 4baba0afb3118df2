// Eigen's LDLT as LinearSolver, compared with dense linear algebra and the multifrontal solver;
// shifts.
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <memory>

#include "framework/random_matrix.h"
#include "majorant/framework/internal/symmetric_eigen.h"

namespace majorant {
namespace {

using test::expect_solves;
using test::Matrix;
using test::Random;
using test::random_matrix;

std::array<std::shared_ptr<LinearSolver>, 2> both_solvers() {
  return {make_eigen_ldlt_solver(), make_direct_solver()};
}

TEST(EigenLdlt, AgreesWithCholmodOnPositiveDefiniteMatrices) {
  Random random(1);
  const std::unique_ptr<LinearSolver> eigen = make_eigen_ldlt_solver(),
                                      direct = make_direct_solver();
  for (const auto& [nodes, block] : {std::pair(1, 1), {2, 1}, {20, 2}, {300, 1}, {150, 2}}) {
    Matrix m = random_matrix(random, nodes, block, 60);
    eigen->analyze(m.pattern);
    direct->analyze(m.pattern);
    for (int round = 0; round < 2; ++round) {  // other values with the same analysis
      ASSERT_EQ(eigen->factorize(m.values, 0), FactorStatus::Ok);
      ASSERT_EQ(direct->factorize(m.values, 0), FactorStatus::Ok);
      expect_solves(*eigen, m.dense, random);
      const Vec r = random.vector(m.pattern.size);
      Vec p, q;
      eigen->solve(r, p);
      direct->solve(r, q);
      EXPECT_LE((p - q).norm(), 1e-12 * q.norm());
      m.values *= -3;
      m.dense *= -3;
      EXPECT_EQ(eigen->factorize(m.values, 0), FactorStatus::NotPositiveDefinite);
      m.values *= -1;
      m.dense *= -1;
    }
  }
}

// With shifts slightly above and below the lowest eigenvalue, both solvers agree with a dense
// eigenvalue decomposition. Eigen alone would factorize indefinite matrices without an error.
TEST(EigenLdlt, AgreesWithCholmodOnDefiniteness) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    const Matrix m = random_matrix(random, 40, 2, random.uniform(0, 12));
    const double lowest = symmetric_eigen(m.dense).values[0];
    for (const auto& solver : both_solvers()) {
      solver->analyze(m.pattern);
      EXPECT_EQ(solver->factorize(m.values, 0),
                lowest > 0 ? FactorStatus::Ok : FactorStatus::NotPositiveDefinite);
      EXPECT_EQ(solver->factorize(m.values, -lowest - 1e-8), FactorStatus::NotPositiveDefinite);
      ASSERT_EQ(solver->factorize(m.values, -lowest + 1e-8), FactorStatus::Ok);
      ASSERT_EQ(solver->factorize(m.values, -lowest + 2), FactorStatus::Ok);
      expect_solves(
          *solver,
          m.dense + (2 - lowest) * Eigen::MatrixXd::Identity(m.pattern.size, m.pattern.size),
          random);
    }
  }
}

TEST(EigenLdlt, ZeroAndNonFinitePivotsAreNotPositiveDefinite) {
  Random random(4);
  const Matrix m = random_matrix(random, 10, 2, 60);
  const auto solver = make_eigen_ldlt_solver();
  solver->analyze(m.pattern);
  EXPECT_EQ(solver->factorize(Vec::Zero(m.values.size()), 0), FactorStatus::NotPositiveDefinite);
  EXPECT_EQ(solver->factorize(Vec::Zero(m.values.size()), 2), FactorStatus::Ok);
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()})
    for (const Index entry : {0, 1, m.pattern.nonzeros() - 1}) {
      Vec values = m.values;
      values[entry] = bad;
      EXPECT_EQ(solver->factorize(values, 0), FactorStatus::NotPositiveDefinite) << bad << entry;
    }
  EXPECT_EQ(solver->factorize(m.values, 0), FactorStatus::Ok);
  expect_solves(*solver, m.dense, random);
}

TEST(EigenLdlt, EmptyMatrixAndDescription) {
  const auto solver = make_eigen_ldlt_solver();
  SparsePattern empty;
  empty.column_starts = {0};
  solver->analyze(empty);
  EXPECT_EQ(solver->factorize(Vec(), 0), FactorStatus::Ok);
  Vec p = Vec::Ones(3);
  solver->solve(Vec(), p);
  EXPECT_EQ(p.size(), 0);
  EXPECT_NE(solver->description().find("Eigen LDLT"), std::string::npos);
}

TEST(FactorizeShifted, TakesTheFirstShiftThatSuffices) {
  Random random(5);
  for (const auto& solver : both_solvers()) {
    const Matrix m = random_matrix(random, 60, 2, 2);
    const double lowest = symmetric_eigen(m.dense).values[0];
    ASSERT_LT(lowest, -0.1);
    solver->analyze(m.pattern);
    for (const double smallest : {1e-14, 1e-3}) {
      const ShiftedFactorization f = factorize_shifted(*solver, m.pattern, m.values, smallest);
      ASSERT_EQ(f.status, FactorStatus::Ok);
      EXPECT_GE(f.shift, -lowest);
      EXPECT_LT(f.shift / 10, -lowest);
      const double steps = std::log10(f.shift / (smallest * m.dense.diagonal().cwiseAbs().mean()));
      EXPECT_NEAR(steps, std::round(steps), 1e-9);
      EXPECT_EQ(f.factorizations, 2 + static_cast<int>(std::lround(steps)));
      EXPECT_EQ(f.failed(), f.factorizations - 1);
      expect_solves(*solver,
                    m.dense + f.shift * Eigen::MatrixXd::Identity(m.pattern.size, m.pattern.size),
                    random);
    }
    const Matrix definite = random_matrix(random, 60, 2, 60);
    solver->analyze(definite.pattern);
    const ShiftedFactorization none =
        factorize_shifted(*solver, definite.pattern, definite.values, 1e-3);
    EXPECT_EQ(none.status, FactorStatus::Ok);
    EXPECT_EQ(none.shift, 0);
    EXPECT_EQ(none.factorizations, 1);
    EXPECT_EQ(none.failed(), 0);
    Vec bad = definite.values;
    bad[0] = std::nan("");
    EXPECT_EQ(factorize_shifted(*solver, definite.pattern, bad, 1e-3).status,
              FactorStatus::NotPositiveDefinite);
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
