// Patterns made by columns and matrices made from entries, against dense matrices.
#include "majorant/framework/sparse_spd.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "majorant/framework/error.h"
#include "support.h"

namespace majorant {
namespace {

using test::Random;

TEST(SparsePattern, SortsAndUnitesTheRowsOfAColumn) {
  SparsePattern p;
  p.append_column({3, 1, 3});
  p.append_column({});
  p.append_column({3});
  p.append_column({});
  p.order_in_blocks(2);
  EXPECT_EQ(p.size, 4);
  EXPECT_EQ(p.column_starts, (std::vector<Index>{0, 3, 4, 6, 7}));
  EXPECT_EQ(p.rows, (std::vector<Index>{0, 1, 3, 1, 2, 3, 3}));
  EXPECT_EQ(p.block_of, (std::vector<Index>{0, 0, 1, 1}));
}

TEST(SparsePattern, FindsEveryEntryFromBothTriangles) {
  SparsePattern p;
  p.append_column({3, 1, 3});
  p.append_column({2});
  p.append_column({3});
  p.append_column({});
  for (Index c = 0; c < p.size; ++c) {
    EXPECT_EQ(p.diagonal_slot(c), p.slot(c, c));
    for (Index k = p.column_starts[c]; k < p.column_starts[c + 1]; ++k) {
      EXPECT_EQ(p.slot(p.rows[k], c), k);
      EXPECT_EQ(p.slot(c, p.rows[k]), k);
    }
  }
}

// Returns random entries of a diagonally dominant matrix, with several for one position, in both
// triangles.
std::vector<SparseSpd::Entry> random_entries(Random& random, Index size) {
  std::vector<SparseSpd::Entry> entries;
  for (Index k = 0; k < 3 * size; ++k)
    entries.push_back({random.integer(0, size - 1), random.integer(0, size - 1), random.uniform()});
  for (Index i = 0; i < size; ++i) entries.push_back({i, i, 3.0 * size});
  return entries;
}

Eigen::MatrixXd dense(Index size, const std::vector<SparseSpd::Entry>& entries) {
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(size, size);
  for (const auto& e : entries) {
    m(e.row, e.column) += e.value;
    if (e.row != e.column) m(e.column, e.row) += e.value;
  }
  return m;
}

TEST(SparseSpd, SolvesAsTheDenseMatrixDoes) {
  Random random(11);
  for (const Index size : {1, 2, 6, 40, 200})
    for (const Index block : {1, 2}) {
      const auto entries = random_entries(random, size);
      SparseSpd made(size, block, entries, "never");
      const SparseSpd matrix = std::move(made);  // the data are moved too
      EXPECT_EQ(matrix.size(), size);
      const Eigen::LLT<Eigen::MatrixXd> oracle(dense(size, entries));
      for (int repeat = 0; repeat < 2; ++repeat) {
        const Vec rhs = random.vector(size);
        const Vec expected = oracle.solve(rhs);
        EXPECT_LT((matrix.solve(rhs) - expected).norm(), 1e-12 * expected.norm()) << size;
      }
    }
}

TEST(SparseSpd, TakesAPatternWithValues) {
  SparsePattern pattern;
  pattern.append_column({2});
  pattern.append_column({2});
  pattern.append_column({});
  pattern.order_in_blocks(1);
  const Vec values = (Vec(5) << 4, 1, 3, -1, 2).finished();
  Eigen::Matrix3d m;
  m << 4, 0, 1, 0, 3, -1, 1, -1, 2;
  const SparseSpd matrix(pattern, values, "never");
  const Vec rhs = Vector3(1, 2, 3);
  EXPECT_LT((m * matrix.solve(rhs) - rhs).norm(), 1e-14);
}

TEST(SparseSpd, ThrowsTheCallersMessageIfNotPositiveDefinite) {
  const std::vector<SparseSpd::Entry> singular{{0, 0, 1}, {1, 0, -1}, {1, 1, 1}};
  try {
    SparseSpd(2, 1, singular, "pieces.obj: floats");
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(static_cast<int>(error.kind()), static_cast<int>(ErrorKind::Infeasible));
    EXPECT_STREQ(error.what(), "pieces.obj: floats");
  }
}

TEST(SparseSpd, PollsBetweenAnalysisAndFactorization) {
  SparsePattern pattern;
  pattern.append_column({});
  pattern.order_in_blocks(1);
  const StopCheck stop([] { return Directive::Interrupt; });
  EXPECT_THROW(SparseSpd(pattern, Vec::Ones(1), "never", stop), Stopped);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
