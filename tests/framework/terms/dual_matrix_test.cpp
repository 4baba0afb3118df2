// Matrices of dual numbers: decompositions compared with differences and exact identities.
#include "majorant/framework/terms/dual_matrix.h"

#include <gtest/gtest.h>

#include <cmath>

#include "majorant/framework/terms/local_term.h"
#include "random.h"

namespace majorant {
namespace {

TEST(DualMatrix, ActiveVariablesAndPassiveValues) {
  const Eigen::Vector3d point(0.3, 1, -2);
  const auto x = dual2_variables(point);
  const auto f = (passive(x[0]) * x.squaredNorm());
  EXPECT_EQ(passive(x), point);
  EXPECT_NEAR(f.v, 0.3 * 5.09, 1e-15);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(f.d[k], 0.6 * point[k], 1e-15);
  EXPECT_NEAR(f.hess(2, 2), 0.6, 1e-15);
  EXPECT_EQ(passive(dual1_variables(point)), point);
  EXPECT_EQ(passive(2.5), 2.5);
}

// A function of U, s and V of an N by N matrix that depends on signs and order.
template <int N>
struct OfSvd {
  template <class Z>
  auto operator()(Index, const Z& z) const {
    using T = typename Z::Scalar;
    Eigen::Matrix<T, N, N> A;
    for (int k = 0; k < N * N; ++k) A(k / N, k % N) = z[k];
    const auto [U, s, V] = svd(A);
    T sum(0.0);
    for (int i = 0; i < N; ++i)
      for (int j = 0; j < N; ++j)
        sum =
            sum + (0.3 + i - 2 * j) * U(i, j) * U(i, j) * s[j] + (1.0 + i * j) * V(i, j) * U(j, i);
    return sum + s[0] * s[N - 1];
  }
};

template <int N>
void test_svd() {
  for (unsigned seed = 1; seed < 30; ++seed) {
    const Vec entries = test::Random(seed).vector(N * N);
    Eigen::Matrix<double, N, N> A;
    for (int k = 0; k < N * N; ++k) A(k / N, k % N) = entries[k];
    const auto [U, s, V] = svd(A);
    EXPECT_LE((U * s.asDiagonal() * V.transpose() - A).norm(), 1e-14);
    EXPECT_NEAR(U.determinant(), 1, 1e-14);
    EXPECT_NEAR(V.determinant(), 1, 1e-14);
    EXPECT_EQ(s[N - 1] > 0, A.determinant() > 0);
    double gap = 1;  // least difference of squared singular values
    for (int i = 0; i + 1 < N; ++i) gap = std::min(gap, s[i] * s[i] - s[i + 1] * s[i + 1]);
    if (gap < 0.05) continue;

    // Tests that A = U diag(s) V^T and U^T U = 1 hold with all derivatives.
    const Eigen::Vector<double, N* N> values = entries;
    const auto x = dual2_variables(values);
    Eigen::Matrix<Dual2<double, N * N>, N, N> of_duals;
    for (int k = 0; k < N * N; ++k) of_duals(k / N, k % N) = x[k];
    const auto [W, t, Z] = svd(of_duals);
    const auto again = (W * t.asDiagonal() * Z.transpose()).eval();
    const auto unit = (W.transpose() * W).eval();
    for (int k = 0; k < N * N; ++k) {
      const auto& entry = again(k / N, k % N);
      const auto& product = unit(k / N, k % N);
      for (int a = 0; a < N * N; ++a) {
        EXPECT_NEAR(entry.d[a], a == k ? 1 : 0, 1e-12 / gap);
        EXPECT_NEAR(product.d[a], 0, 1e-12 / gap);
      }
      for (std::size_t h = 0; h < entry.h.size(); ++h) {
        EXPECT_NEAR(entry.h[h], 0, 1e-11 / (gap * gap));
        EXPECT_NEAR(product.h[h], 0, 1e-11 / (gap * gap));
      }
    }
    const auto term = make_term<N * N>(
        "of svd", Cells(Eigen::RowVectorXi::LinSpaced(N * N, 0, N * N - 1)), OfSvd<N>());
    const DerivativeReport report = check_derivatives(*term, entries, 1e-5 / gap);
    EXPECT_TRUE(report.ok()) << report.message();
  }
}

TEST(DualMatrix, SvdOfTwoByTwoHasItsDerivatives) { test_svd<2>(); }
TEST(DualMatrix, SvdOfThreeByThreeHasItsDerivatives) { test_svd<3>(); }

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
