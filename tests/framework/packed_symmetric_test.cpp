// Clamped eigenvalues of packed symmetric matrices.
#include "majorant/framework/detail/packed_symmetric.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "majorant/framework/internal/symmetric_eigen.h"
#include "random.h"

namespace majorant {
namespace {

Eigen::MatrixXd unpacked(int size, const double* k) {
  Eigen::MatrixXd m(size, size);
  for (int i = 0; i < size; ++i)
    for (int j = 0; j <= i; ++j) m(i, j) = m(j, i) = *k++;
  return m;
}

template <int N>
void clamp_random_matrices() {
  test::Random random(N);
  for (int trial = 0; trial < 20; ++trial)
    for (const double projection_weight : {0.0, 0.3, 1.0}) {
      double k[N * (N + 1) / 2];
      for (double& entry : k) entry = random.uniform();
      const Eigen::MatrixXd before = unpacked(N, k);
      double rotated[N * (N + 1) / 2];
      std::copy(std::begin(k), std::end(k), rotated);
      clamp_eigenvalues(N, projection_weight, k);
      make_semidefinite<N>(projection_weight, rotated);
      const SymmetricEigen eigen = symmetric_eigen(before);
      Eigen::MatrixXd expected = before;
      for (int i = 0; i < N; ++i)
        if (const double l = eigen.values[i]; l < 0)
          expected -=
              projection_weight * l * eigen.vectors.col(i) * eigen.vectors.col(i).transpose();
      EXPECT_LE((unpacked(N, k) - expected).norm(), 1e-13 * (1 + before.norm())) << N;
      EXPECT_LE((unpacked(N, rotated) - expected).norm(), 1e-13 * (1 + before.norm())) << N;
    }
}

TEST(PackedSymmetric, RemovesNegativeEigenvalues) {
  clamp_random_matrices<1>();
  clamp_random_matrices<2>();
  clamp_random_matrices<3>();
  clamp_random_matrices<6>();
  clamp_random_matrices<12>();
}

TEST(PackedSymmetric, LeavesDefiniteMatricesToTheBit) {
  double k[] = {2, 0.1, 3, 0.3, 0.7, 4};
  const std::vector<double> before(std::begin(k), std::end(k));
  clamp_eigenvalues(3, 1, k);
  for (std::size_t p = 0; p < before.size(); ++p) EXPECT_EQ(k[p], before[p]);
}

// Random matrices of full and lower rank, with eigenvalues moved across 0 by more than rounding.
template <int N>
void judge_random_matrices() {
  test::Random random(N);
  for (int trial = 0; trial < 50; ++trial) {
    Eigen::MatrixXd half = Eigen::MatrixXd::NullaryExpr(N, N, [&] { return random.uniform(); });
    half.rightCols(random.integer(0, N - 1)).setZero();
    const Vec direction = random.vector(N).normalized();
    const auto judged = [&](double part) {
      const Eigen::MatrixXd m =
          half * half.transpose() + part * half.squaredNorm() * direction * direction.transpose();
      double k[N * (N + 1) / 2];
      for (int i = 0, p = 0; i < N; ++i)
        for (int j = 0; j <= i; ++j, ++p) k[p] = m(i, j);
      const double lowest = symmetric_eigen(m).values[0];
      return std::pair(is_semidefinite<N>(k), lowest / half.squaredNorm());
    };
    for (const double part : {0.1, 0.01, -0.001, -0.1, -1.0}) {
      const auto [printed, lowest] = judged(part);
      EXPECT_TRUE(printed ? lowest >= -1e-12 : lowest < 1e-6) << N << " " << part << " " << lowest;
    }
  }
}

TEST(PackedSymmetric, Semidefinite) {
  judge_random_matrices<2>();
  judge_random_matrices<4>();
  judge_random_matrices<9>();
  const double spring[] = {2, -1, 3, -2, 1, 2, 1, -3, -1, 3};  // translations are free
  EXPECT_TRUE(is_semidefinite<4>(spring));
  const double hollow[] = {0, 1, 5}, zero[] = {0, 0, 0}, nan[] = {1, std::nan(""), 1};
  EXPECT_FALSE(is_semidefinite<2>(hollow));
  EXPECT_TRUE(is_semidefinite<2>(zero));
  EXPECT_FALSE(is_semidefinite<2>(nan));
}

TEST(PackedSymmetric, RotationsOfAnySize) {
  for (const double size : {1e-300, 1e-20, 1e100, 1e150}) {
    double k[] = {size, 3 * size, -size, 0.1 * size, -2 * size, 5 * size};
    const Eigen::MatrixXd before = unpacked(3, k);
    make_semidefinite<3>(1, k);
    const SymmetricEigen eigen = symmetric_eigen(before);
    const Eigen::MatrixXd expected =
        eigen.vectors * eigen.values.cwiseMax(0.0).asDiagonal() * eigen.vectors.transpose();
    EXPECT_LE((unpacked(3, k) - expected).cwiseAbs().maxCoeff(), 1e-13 * size);
  }
}

TEST(PackedSymmetric, NotFinite) {
  for (const double bad :
       {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    double k[] = {2, bad, 3};
    make_semidefinite<2>(1, k);
    for (const double entry : k) EXPECT_EQ(entry, 0);
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
