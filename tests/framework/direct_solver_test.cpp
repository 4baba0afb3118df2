// Compares the sparse Cholesky solvers, the library's and CHOLMOD, with dense linear algebra.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <limits>

#include "counted_stop.h"
#include "framework/random_matrix.h"
#include "majorant/framework/argument_check.h"
#include "majorant/framework/cholmod_solver.h"
#include "majorant/framework/error.h"
#include "majorant/framework/internal/front_kernels.h"
#include "majorant/framework/internal/symmetric_eigen.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/pattern_of_pairs.h"

namespace majorant {
namespace {

using test::expect_solves;
using test::Matrix;
using test::Random;
using test::random_matrix;

class OwnSolver : public testing::TestWithParam<Ordering> {
 protected:
  std::unique_ptr<DirectSolver> make() const {
    return make_direct_solver({.ordering = GetParam()});
  }
};

// Returns the Laplacian of a square grid plus the identity.
Matrix grid_matrix(Index side) {
  const Index size = side * side;
  Matrix m;
  const auto for_each_edge = [&](const auto& use) {
    for (Index k = 0; k < size; ++k) {
      if (k % side + 1 < side) use(k, k + 1);
      if (k + side < size) use(k, k + side);
    }
  };
  m.pattern = pattern_of_pairs(size, 1, [&](const auto& add) {
    for (Index k = 0; k < size; ++k) add(k, k);
    for_each_edge(add);
  });
  m.values = Vec::Zero(m.pattern.nonzeros());
  m.dense = Eigen::MatrixXd::Zero(size, size);
  const auto add = [&](Index a, Index b, double value) {
    m.values[m.pattern.slot(a, b)] += value;
    m.dense(a, b) += value;
    if (a != b) m.dense(b, a) += value;
  };
  for (Index k = 0; k < size; ++k) add(k, k, 1);
  for_each_edge([&](Index a, Index b) {
    add(a, a, 1);
    add(b, b, 1);
    add(a, b, -1);
  });
  return m;
}

// A factorization ends within some fronts of a stop, which does not affect the next one.
TEST_P(OwnSolver, StopsBetweenFronts) {
  Random random(1);
  const Matrix m = grid_matrix(40);
  const auto solver = make();
  solver->analyze(m.pattern);
  const CountedStop never;
  ASSERT_EQ(solver->factorize_until(never.check(), m.values, 0), FactorStatus::Ok);
  EXPECT_GE(never.polls(), 1600 / 16 / 10);  // fronts have about ten columns
  for (long k = 1; k <= never.polls(); ++k) {
    const CountedStop stop(k);
    EXPECT_THROW(solver->factorize_until(stop.check(), m.values, 0), Stopped);
    EXPECT_LE(stop.polls_after(), ThreadCount::current());
  }
  ASSERT_EQ(solver->factorize(m.values, 0), FactorStatus::Ok);
  expect_solves(*solver, m.dense, random);
}

using Factor = CholmodOptions::Factor;

struct NamedSolver {
  const char* name;
  SolverFactory make;
  friend void PrintTo(const NamedSolver& s, std::ostream* out) { *out << s.name; }
};

NamedSolver own(const char* name, Ordering ordering) {
  return {name, [ordering] { return make_direct_solver({.ordering = ordering}); }};
}
NamedSolver cholmod(const char* name, Ordering ordering, Factor factor) {
  return {name, [=] { return make_cholmod_solver({ordering, factor}); }};
}

class Factorization : public testing::TestWithParam<NamedSolver> {
 protected:
  std::shared_ptr<LinearSolver> make() const { return GetParam().make(); }
};

TEST_P(Factorization, SolvesPositiveDefiniteSystems) {
  Random random(1);
  const auto solver = make();
  for (const auto& [nodes, block] :
       {std::pair(1, 1), {1, 2}, {2, 1}, {20, 2}, {300, 1}, {150, 2}}) {
    const Matrix m = random_matrix(random, nodes, block, 60);
    solver->analyze(m.pattern);
    ASSERT_EQ(solver->factorize(m.values, 0), FactorStatus::Ok) << nodes << ' ' << block;
    expect_solves(*solver, m.dense, random);
    expect_solves(*solver, m.dense, random);
  }
}

TEST_P(OwnSolver, ProductsInTheInverse) {
  Random random(3);
  const auto solver = make();
  for (const auto& [nodes, block] : {std::pair(1, 1), {20, 2}, {300, 1}}) {
    const Matrix m = random_matrix(random, nodes, block, 60);
    const auto size = static_cast<Index>(m.dense.rows());
    std::vector<DirectSolver::SparseColumn> columns;
    Eigen::MatrixXd r = Eigen::MatrixXd::Zero(size, 3);
    for (Index k = 0; k < 3; ++k) {
      const Index first = k * (size - 1) / 3, last = size - 1;
      columns.push_back({{first, 2.0 + k}});
      if (first < last) columns.back().emplace_back(last, -1);
      for (const auto& [unknown, value] : columns.back()) r(unknown, k) = value;
    }
    const double shift = 0.5;
    solver->analyze(m.pattern);
    ASSERT_EQ(solver->factorize(m.values, shift), FactorStatus::Ok) << nodes << ' ' << block;
    const Eigen::MatrixXd h = m.dense + shift * Eigen::MatrixXd::Identity(size, size);
    const Eigen::MatrixXd expected = r.transpose() * h.ldlt().solve(r);
    const Eigen::MatrixXd found = solver->inverse_products(size, columns);
    EXPECT_LE((found - expected).norm(), 1e-10 * expected.norm()) << nodes << ' ' << block;
    expect_solves(*solver, h, random);
  }
}

TEST_P(OwnSolver, EntriesOfASolution) {
  Random random(4);
  const auto solver = make();
  for (const auto& [nodes, block] : {std::pair(1, 1), {20, 2}, {1000, 1}}) {
    const Matrix m = random_matrix(random, nodes, block, 60);
    const auto size = m.pattern.size;
    solver->analyze(m.pattern);
    ASSERT_EQ(solver->factorize(m.values, 0.5), FactorStatus::Ok) << nodes << ' ' << block;
    for (const Index k : {0, size / 3, size - 1}) {
      Vec r = Vec::Zero(size), p;
      r[k] = 2;
      r[size - 1] -= 0.5;
      DirectSolver::SparseColumn column{{k, 2.0}, {size - 1, -0.5}};
      const std::vector<Index> unknowns{size / 2, 0, k, size - 1, size / 2};
      const Vec found = solver->solution_entries(size, column, unknowns);
      solver->solve(r, p);
      EXPECT_EQ(found, Vec(p(unknowns))) << nodes << ' ' << block << ' ' << k;
    }
  }
}

// More threads need more scratch memory.
TEST_P(OwnSolver, HasTheThreadsThatItIsGiven) {
  const Index side = 300;
  const SparsePattern pattern = pattern_of_pairs(side * side, 1, [&](const auto& add) {
    for (Index k = 0; k < side * side; ++k) {
      if (k % side + 1 < side) add(k, k + 1);
      if (k + side < side * side) add(k, k + side);
    }
  });
  const auto bytes = [&](int given, int of_caller) {
    const ThreadCount caller(of_caller);
    const auto solver = make_direct_solver({.ordering = GetParam(), .threads = given});
    solver->analyze(pattern);
    return solver->bytes();
  };
  EXPECT_GT(bytes(4, 1), bytes(1, 4));
  EXPECT_EQ(bytes(0, 4), bytes(4, 1));
  EXPECT_EQ(bytes(0, 1), bytes(1, 4));
}

// The bytes are known before memory is allocated. A second analysis of the same pattern gives equal
// bytes, description and solution.
TEST_P(OwnSolver, BytesAreKnownAfterTheAnalysis) {
  Random random(9);
  const Matrix small = random_matrix(random, 20, 2, 60), large = random_matrix(random, 150, 2, 60);
  const auto solver = make();
  EXPECT_EQ(solver->bytes(), 0u);
  const Vec r = random.vector(large.pattern.size);
  std::vector<std::size_t> bytes;
  std::vector<Vec> solutions;
  std::vector<std::string> descriptions;
  for (const auto& [m, times] : {std::pair(&small, 1), {&large, 1}, {&small, 1}, {&large, 2}}) {
    for (int k = 0; k < times; ++k) solver->analyze(m->pattern);
    bytes.push_back(solver->bytes());
    EXPECT_GE(bytes.back(), m->pattern.rows.size() * sizeof(double));
    ASSERT_EQ(solver->factorize(m->values, 0), FactorStatus::Ok);
    EXPECT_EQ(solver->bytes(), bytes.back());
    solver->solve(r.head(m->pattern.size), solutions.emplace_back());
    descriptions.push_back(solver->description());
  }
  EXPECT_LT(bytes[0], bytes[1]);
  EXPECT_EQ(bytes[1], bytes[3]);
  EXPECT_EQ(descriptions[1], descriptions[3]);
  EXPECT_EQ(solutions[1], solutions[3]);
}

TEST(SparsePattern, RefusesMoreEntriesThanItCounts) {
  EXPECT_EQ(counted("entries", 2147483647), 2147483647);
  try {
    counted("entries", std::size_t{2147483648});
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::Unsupported);
    EXPECT_NE(std::string(e.what()).find("2147483648"), std::string::npos) << e.what();
  }
  // The lists have three numbers per node.
  EXPECT_EQ(counted("nodes", 715827882, 3), 715827882);
  EXPECT_THROW(counted("nodes", 715827883, 3), Error);
  EXPECT_THROW(counted("nodes", std::numeric_limits<std::size_t>::max(), 3), Error);
}

TEST_P(Factorization, RefactorizesOtherValues) {
  Random random(2);
  const auto solver = make();
  Matrix m = random_matrix(random, 80, 2, 60);
  solver->analyze(m.pattern);
  for (int k = 0; k < 3; ++k) {
    ASSERT_EQ(solver->factorize(m.values, 0), FactorStatus::Ok);
    expect_solves(*solver, m.dense, random);
    m.values *= 0.1;
    m.dense *= 0.1;
  }
}

// The patterns change gradually.
TEST_P(OwnSolver, KeepsAnOrderingWhileItServes) {
  Random random(4);
  const auto solver = make();
  ElementDofs s = test::random_elements(random, 150, 3, 200, 2);
  const Elimination all(400, ConstraintRows{});
  int kept = 0, ordered = 0;
  for (int round = 0; round < 40; ++round) {
    for (int k = 0; k < 3; ++k) s.nodes(random.integer(0, 149), 0) = random.integer(0, 199);
    const Matrix m = test::random_matrix(random, s, all, 60);
    solver->analyze(m.pattern);
    ASSERT_EQ(solver->factorize(m.values, 0), FactorStatus::Ok) << round;
    expect_solves(*solver, m.dense, random);
    (solver->description().find("earlier") == std::string::npos ? ordered : kept) += 1;
  }
  EXPECT_GE(kept, 20);
  EXPECT_GE(ordered, 2);  // the first time, and when operations exceed the bound
}

TEST_P(Factorization, DetectsIndefinitenessAndRecoversByShift) {
  Random random(3);
  const auto solver = make();
  const Matrix m = random_matrix(random, 100, 2, 2);
  const Index n = m.pattern.size;
  const double lowest = symmetric_eigen(m.dense).values[0];
  ASSERT_LT(lowest, -0.1);
  solver->analyze(m.pattern);
  EXPECT_EQ(solver->factorize(m.values, 0), FactorStatus::NotPositiveDefinite);
  EXPECT_EQ(solver->factorize(m.values, -lowest - 0.01), FactorStatus::NotPositiveDefinite);
  ASSERT_EQ(solver->factorize(m.values, -lowest + 0.01), FactorStatus::Ok);
  const double shift = -lowest + 3;
  ASSERT_EQ(solver->factorize(m.values, shift), FactorStatus::Ok);
  expect_solves(*solver, m.dense + shift * Eigen::MatrixXd::Identity(n, n), random);
  EXPECT_EQ(solver->factorize(m.values, 0), FactorStatus::NotPositiveDefinite);
}

TEST_P(Factorization, ZeroMatrixIsNotPositiveDefinite) {
  Random random(4);
  const auto solver = make();
  Matrix m = random_matrix(random, 10, 2, 0);
  m.values.setZero();
  solver->analyze(m.pattern);
  EXPECT_EQ(solver->factorize(m.values, 0), FactorStatus::NotPositiveDefinite);
  EXPECT_EQ(solver->factorize(m.values, 2), FactorStatus::Ok);
  Vec p;
  solver->solve(Vec::Ones(20), p);
  EXPECT_LE((p - Vec::Constant(20, 0.5)).norm(), 1e-15);
}

TEST_P(Factorization, EmptyMatrix) {
  const auto solver = make();
  SparsePattern empty;
  empty.column_starts = {0};
  solver->analyze(empty);
  EXPECT_EQ(solver->factorize(Vec(), 0), FactorStatus::Ok);
  Vec p = Vec::Ones(3);
  solver->solve(Vec(), p);
  EXPECT_EQ(p.size(), 0);
}

TEST_P(OwnSolver, DescriptionNamesKernelsAndOrdering) {
  Random random(5);
  const auto solver = make();
  const Matrix m = random_matrix(random, 100, 2, 60);
  solver->analyze(m.pattern);
  const std::string d = solver->description();
  const auto has = [&](const char* word) { return d.find(word) != std::string::npos; };
  EXPECT_TRUE(has("multifrontal")) << d;
  EXPECT_TRUE(has(front_kernels().name)) << d;
  EXPECT_EQ(has("METIS"), GetParam() == Ordering::Metis) << d;
  EXPECT_EQ(has("AMD"), GetParam() != Ordering::Metis) << d;
}

// Shifts slightly above and below the lowest eigenvalue.
TEST_P(Factorization, DefiniteIfTheShiftExceedsTheLowestEigenvalue) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    const Matrix m = random_matrix(random, 40, 2, random.uniform(0, 12));
    const double lowest = symmetric_eigen(m.dense).values[0];
    const auto solver = make();
    solver->analyze(m.pattern);
    EXPECT_EQ(solver->factorize(m.values, 0),
              lowest > 0 ? FactorStatus::Ok : FactorStatus::NotPositiveDefinite);
    EXPECT_EQ(solver->factorize(m.values, -lowest - 1e-8), FactorStatus::NotPositiveDefinite);
    EXPECT_EQ(solver->factorize(m.values, -lowest + 1e-8), FactorStatus::Ok);
  }
}

TEST_P(Factorization, NumbersThatAreNotFiniteAreNotPositiveDefinite) {
  Random random(4);
  const Matrix m = random_matrix(random, 100, 2, 60);
  const auto solver = make();
  solver->analyze(m.pattern);
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()})
    for (const Index entry : {0, 1, m.pattern.nonzeros() - 1}) {
      Vec values = m.values;
      values[entry] = bad;
      EXPECT_EQ(solver->factorize(values, 0), FactorStatus::NotPositiveDefinite) << bad << entry;
    }
  ASSERT_EQ(solver->factorize(m.values, 0), FactorStatus::Ok);
  expect_solves(*solver, m.dense, random);
}

// There must be no solve without a factor, or with one of another pattern.
TEST_P(Factorization, TakesOtherPatterns) {
  Random random(6);
  const auto solver = make();
  EXPECT_EQ(solver->bytes(), 0u);
  for (const Index nodes : {30, 200, 30, 7}) {
    const Matrix m = random_matrix(random, nodes, 2, 60);
    solver->analyze(m.pattern);
    EXPECT_GE(solver->bytes(), m.pattern.rows.size() * sizeof(double));
    EXPECT_THROW(solver->factorize(m.values.head(1), 0), InvalidArgument);
    ASSERT_EQ(solver->factorize(m.values, 0), FactorStatus::Ok);
    expect_solves(*solver, m.dense, random);
    Vec p;
    EXPECT_THROW(solver->solve(Vec::Ones(3), p), InvalidArgument);
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, Factorization,
    testing::Values(own("own", Ordering::Automatic), own("own_amd", Ordering::Amd),
                    own("own_metis", Ordering::Metis),
                    cholmod("cholmod", Ordering::Automatic, Factor::Automatic),
                    cholmod("cholmod_simplicial", Ordering::Amd, Factor::Simplicial),
                    cholmod("cholmod_supernodal", Ordering::Amd, Factor::Supernodal),
                    cholmod("cholmod_metis", Ordering::Metis, Factor::Supernodal)),
    [](const auto& solver) { return std::string(solver.param.name); });

TEST(Cholmod, DescriptionNamesTheOrdering) {
  Random random(5);
  const Matrix m = random_matrix(random, 100, 2, 60);
  for (const bool supernodal : {false, true})
    for (const bool metis : {false, true}) {
      const auto solver =
          make_cholmod_solver({metis ? Ordering::Metis : Ordering::Amd,
                               supernodal ? Factor::Supernodal : Factor::Simplicial});
      solver->analyze(m.pattern);
      const std::string d = solver->description();
      EXPECT_NE(d.find(supernodal ? "supernodal" : "simplicial"), std::string::npos) << d;
      EXPECT_NE(d.find(metis ? "METIS" : "AMD"), std::string::npos) << d;
    }
}

// Both solvers factorize the same matrix by Cholesky.
TEST(Cholmod, SolvesAsTheOwnFactorization) {
  Random random(8);
  for (const Index nodes : {50, 400}) {
    const Matrix m = random_matrix(random, nodes, 2, 60);
    const Vec r = random.vector(m.pattern.size);
    std::vector<Vec> solutions;
    const std::shared_ptr<LinearSolver> own = make_direct_solver(), other = make_cholmod_solver();
    for (const auto& solver : {own, other}) {
      solver->analyze(m.pattern);
      ASSERT_EQ(solver->factorize(m.values, 0), FactorStatus::Ok);
      solver->solve(r, solutions.emplace_back());
    }
    EXPECT_LE((solutions[0] - solutions[1]).norm(), 1e-12 * solutions[0].norm());
  }
}

Index thread_count() {
  return static_cast<Index>(std::distance(std::filesystem::directory_iterator("/proc/self/task"),
                                          std::filesystem::directory_iterator()));
}

// Ends the process with 0 if a factorization and a solve start no thread. The matrix is large
// enough for CHOLMOD's loops to request four OpenMP threads.
[[noreturn]] void factorize_and_count_threads() {
  Random random(11);
  const Matrix m = random_matrix(random, 600, 2, 60);
  const auto solver = make_cholmod_solver({Ordering::Amd, Factor::Supernodal});
  const Index before = thread_count();
  solver->analyze(m.pattern);
  Vec p;
  const bool solved = solver->factorize(m.values, 0) == FactorStatus::Ok;
  solver->solve(random.vector(m.pattern.size), p);
  std::_Exit(solved && thread_count() == before ? 0 : 1);
}

TEST(CholmodDeathTest, ComputesOnTheThreadThatCallsIt) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // a new process without a thread pool
  EXPECT_EXIT(factorize_and_count_threads(), testing::ExitedWithCode(0), "");
}

INSTANTIATE_TEST_SUITE_P(All, OwnSolver,
                         testing::Values(Ordering::Automatic, Ordering::Amd, Ordering::Metis));

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
