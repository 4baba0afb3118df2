// Determinant coefficients of both halves of a quadrilateral, and derivatives of the barrier.
#include "majorant/parametrization/scaffold/internal/moving_barrier.h"

#include "majorant/elements/bernstein.h"
#include "majorant/framework/internal/symmetric_eigen.h"
#include "maps/test_maps.h"
#include "parametrization/scaffold/bezier_mesh_helpers.h"

namespace majorant {
namespace {

TEST(MovingBarrier, CoefficientsAreThoseOfTheElement) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int n = 1; n <= 8; ++n) {
    const MovingBarrier& barrier = MovingBarrier::of_degree(n);
    Points2 grid((n + 1) * (n + 1), 2);
    for (int q = 0; q <= n; ++q)
      for (int p = 0; p <= n; ++p)
        grid.row(q * (n + 1) + p) << p + 0.6 * uniform(random), q + 0.6 * uniform(random);
    const Vec b = barrier.coefficients(grid);
    const TriangleIndices& indices = TriangleIndices::of_degree(n);
    const int count = barrier.coefficient_count() / 2, last = (n + 1) * (n + 1) - 1;
    const TriangleIndices& determinant = TriangleIndices::of_degree(2 * n - 2);
    for (int half = 0; half < 2; ++half) {
      Points2 local(indices.count(), 2);
      for (int l = 0; l < indices.count(); ++l) {
        const auto [i, j, k] = indices.multi(l);
        const int row = (j + k) * (n + 1) + j;
        local.row(l) = grid.row(half == 0 ? row : last - row);
      }
      const double straight = triangle_determinant(local, 0, 1, 2);
      EXPECT_NEAR(barrier.straight_determinants(grid)[half], straight, 1e-13);
      for (int trial = 0; trial < 20; ++trial) {
        const Barycentric xi = random_point(random);
        const Eigen::Matrix2d j = local.transpose() * bernstein_gradients(n, xi);
        const Vec values = bernstein_values(2 * n - 2, xi);
        ASSERT_EQ(values.size(), determinant.count());
        EXPECT_NEAR(values.dot(b.segment(half * count, count)), j.determinant() / straight, 1e-11)
            << n;
      }
    }
  }
}

TEST(MovingBarrier, DerivativesAreThoseOfDifferences) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int n = 2; n <= 5; ++n) {
    const MovingBarrier& barrier = MovingBarrier::of_degree(n);
    Points2 grid((n + 1) * (n + 1), 2);
    for (int q = 0; q <= n; ++q)
      for (int p = 0; p <= n; ++p)
        grid.row(q * (n + 1) + p) << p + 0.3 * uniform(random), q + 0.3 * uniform(random);
    const double mu = barrier.coefficients(grid).minCoeff() - 0.5;
    const auto model = barrier.model(grid, mu);
    const double step = 1e-6;
    for (int v = 0; v < barrier.variable_count(); ++v) {
      const int row = (v / 2 / (n - 1) + 1) * (n + 1) + v / 2 % (n - 1) + 1;
      Points2 plus = grid, minus = grid;
      plus(row, v % 2) += step;
      minus(row, v % 2) -= step;
      const auto after = barrier.model(plus, mu), before = barrier.model(minus, mu);
      const double scale = model.gradient.norm();
      EXPECT_NEAR((after.value - before.value) / (2 * step), model.gradient[v], 1e-6 * scale);
      EXPECT_LT(((after.gradient - before.gradient) / (2 * step) - model.hessian.col(v)).norm(),
                1e-5 * model.hessian.norm());
    }
    EXPECT_LT((model.hessian - model.hessian.transpose()).norm(), 1e-12 * model.hessian.norm());
    EXPECT_GE(symmetric_eigen(model.gauss_newton).values[0], -1e-12 * model.gauss_newton.norm());
  }
}

// A grid without folds stays without folds; the objective of an affine one is 0.
TEST(MovingBarrier, EndsWherePositive) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int n = 2; n <= 8; ++n) {
    const MovingBarrier& barrier = MovingBarrier::of_degree(n);
    Points2 affine((n + 1) * (n + 1), 2), grid;
    for (int q = 0; q <= n; ++q)
      for (int p = 0; p <= n; ++p) affine.row(q * (n + 1) + p) << 3 * p + q, 2 * q - p;
    EXPECT_NEAR(barrier.model(affine, 0).value, 0, 1e-20);
    for (int trial = 0; trial < 10; ++trial) {
      grid = affine;
      for (int q = 1; q < n; ++q)
        for (int p = 1; p < n; ++p) grid.row(q * (n + 1) + p) += Vector2(uniform(random), 2) * n;
      EXPECT_LT(barrier.coefficients(grid).minCoeff(), 0);
      const double worst = barrier.minimize(grid);
      EXPECT_GT(worst, 0.05) << n;
      EXPECT_NEAR(worst, barrier.coefficients(grid).minCoeff(), 1e-10);
    }
  }
  EXPECT_THROW(MovingBarrier::of_degree(0), std::out_of_range);
  EXPECT_THROW(MovingBarrier::of_degree(9), std::out_of_range);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
