// The small matrices of formulas of density<M, D>, and the projection of their Hessians.
#include <gtest/gtest.h>

#include "energies/density_fixture.h"
#include "majorant/energies/internal/point_densities.h"
#include "majorant/framework/detail/packed_symmetric.h"

namespace majorant {
namespace {

// ---- SmallMatrix ----

template <int R, int C>
SmallMatrix<double, R, C> small(const Eigen::Matrix<double, R, C>& m) {
  SmallMatrix<double, R, C> out;
  for (int i = 0; i < R; ++i)
    for (int j = 0; j < C; ++j) out(i, j) = m(i, j);
  return out;
}

template <int R, int C>
void expect_equal(const SmallMatrix<double, R, C>& a, const Eigen::Matrix<double, R, C>& b) {
  for (int i = 0; i < R; ++i)
    for (int j = 0; j < C; ++j) EXPECT_NEAR(a(i, j), b(i, j), 1e-13 * (1 + b.norm())) << i << j;
}

template <int N>
void expect_square_algebra(test::Random& random) {
  using M = Eigen::Matrix<double, N, N>;
  const M a = Eigen::Map<const M>(random.vector(N * N).eval().data());
  EXPECT_NEAR((small<N, N>(a).determinant()), a.determinant(), 1e-14);
  EXPECT_NEAR((small<N, N>(a).trace()), a.trace(), 1e-14);
  if constexpr (N > 1) {
    expect_equal<N, N>(small<N, N>(a).inverse(), a.inverse());
    expect_equal<N, N>(small<N, N>(a).adjugate(), a.inverse() * a.determinant());
  }
}

TEST(SmallMatrix, AgreesWithEigen) {
  test::Random random(3);
  for (int k = 0; k < 20; ++k) {
    expect_square_algebra<1>(random);
    expect_square_algebra<2>(random);
    expect_square_algebra<3>(random);
    using A = Eigen::Matrix<double, 3, 2>;
    using B = Eigen::Matrix<double, 2, 4>;
    const A a = Eigen::Map<const A>(random.vector(6).eval().data());
    const A a2 = Eigen::Map<const A>(random.vector(6).eval().data());
    const B b = Eigen::Map<const B>(random.vector(8).eval().data());
    expect_equal<3, 4>(small<3, 2>(a) * small<2, 4>(b), a * b);
    expect_equal<2, 3>(small<3, 2>(a).transpose(), a.transpose());
    expect_equal<3, 2>(small<3, 2>(a) + small<3, 2>(a2), a + a2);
    expect_equal<3, 2>(small<3, 2>(a) - small<3, 2>(a2), a - a2);
    expect_equal<3, 2>(-2.5 * small<3, 2>(a), -2.5 * a);
    EXPECT_NEAR((small<3, 2>(a).squaredNorm()), a.squaredNorm(), 1e-14);
  }
}

// ---- Projection ----

template <int N>
void expect_lanes_by_themselves(test::Random& random) {
  using Batch = xsimd::batch<double>;
  constexpr int kPacked = N * (N + 1) / 2, kLanes = static_cast<int>(Batch::size);
  for (int round = 0; round < 40; ++round) {
    double matrices[kLanes][kPacked];
    Batch all[kPacked], copies[kPacked];
    for (int l = 0; l < kLanes; ++l) {
      const Vec v = random.vector(N), entries = random.vector(kPacked);
      const int kind = (round + l) % 5;
      for (int i = 0, p = 0; i < N; ++i)
        for (int j = 0; j <= i; ++j, ++p)
          matrices[l][p] = kind == 0   ? entries[p]
                           : kind == 1 ? v[i] * v[j]
                           : kind == 2 ? -1e150 * v[i] * v[j]
                           : kind == 3 ? 1e-150 * entries[p]
                                       : (i == j) + 0.01 * entries[p];
    }
    if (round % 4 == 1) matrices[0][kPacked - 1] = NAN;
    double row[kLanes];
    for (int p = 0; p < kPacked; ++p) {
      for (int l = 0; l < kLanes; ++l) row[l] = matrices[l][p];
      all[p] = Batch::load_unaligned(row);
      copies[p] = Batch(matrices[kLanes - 1][p]);
    }
    const double projection_weight = round % 3 == 0 ? 1 : 0.3;
    make_semidefinite_batch<N>(projection_weight, all);
    make_semidefinite_batch<N>(projection_weight, copies);
    for (int p = 0; p < kPacked; ++p) EXPECT_EQ(all[p].get(kLanes - 1), copies[p].get(0));
    for (int l = 0; l < kLanes; ++l) {
      const double size = Eigen::Map<const Vec>(matrices[l], kPacked).cwiseAbs().maxCoeff();
      make_semidefinite<N>(projection_weight, matrices[l]);
      for (int p = 0; p < kPacked; ++p)
        EXPECT_LE(std::abs(all[p].get(l) - matrices[l][p]),
                  l == 0 && round % 4 == 1 ? 0 : 1e-13 * size);
    }
  }
}

TEST(SemidefiniteBatch, LanesAreIndependent) {
  test::Random random(7);
  expect_lanes_by_themselves<1>(random);
  expect_lanes_by_themselves<2>(random);
  expect_lanes_by_themselves<4>(random);
  expect_lanes_by_themselves<9>(random);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
