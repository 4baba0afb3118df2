// Random symmetric matrices on patterns of assembly, for tests of linear solvers.
#pragma once

#include <gtest/gtest.h>

#include "framework/quadratic_term.h"
#include "majorant/framework/assembly.h"
#include "majorant/framework/linear_solver.h"

namespace majorant::test {

struct Matrix {
  SparsePattern pattern;
  Vec values;
  Eigen::MatrixXd dense;
};

// Returns a random symmetric matrix on the pattern of element_dofs, which is positive definite if
// `diagonal` is large enough.
inline Matrix random_matrix(Random& random, const ElementDofs& s, const Elimination& all,
                            double diagonal) {
  const Index size = all.full_size();
  Matrix m{reduced_pattern({&s}, all), {}, Eigen::MatrixXd::Zero(size, size)};
  m.values = random.vector(m.pattern.nonzeros());
  for (Index c = 0; c < m.pattern.size; ++c)
    for (Index k = m.pattern.column_starts[static_cast<std::size_t>(c)];
         k < m.pattern.column_starts[static_cast<std::size_t>(c) + 1]; ++k) {
      const Index r = m.pattern.rows[static_cast<std::size_t>(k)];
      if (r == c) m.values[k] += diagonal;
      m.dense(r, c) = m.dense(c, r) = m.values[k];
    }
  return m;
}

// Returns such a matrix on the pattern of random element_dofs.
inline Matrix random_matrix(Random& random, Index nodes, int block, double diagonal) {
  const ElementDofs s = random_elements(random, 2 * nodes, 3, nodes, block);
  return random_matrix(random, s, Elimination(nodes * block, ConstraintRows{}), diagonal);
}

inline void expect_solves(LinearSolver& solver, const Eigen::MatrixXd& dense, Random& random) {
  const Vec r = random.vector(dense.rows());
  Vec p;
  solver.solve(r, p);
  EXPECT_LE((dense * p - r).norm(), 1e-11 * (dense.norm() * p.norm()));
}

}  // namespace majorant::test

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
