// Small vectors and matrices of dual numbers: variables of differentiation in one call, passive
// values, singular value decompositions.
//
//   const Eigen::Vector3d point(0.3, 1, -2);
//   const auto x = dual2_variables(point);            // 3 variables, x[k].d[k] = 1
//   const Eigen::Vector3d same = passive(x);          // values, without derivatives
//   const auto f = passive(x[0]) * x.squaredNorm();   // the first factor is a constant
//
//   Eigen::Matrix2d F;
//   F << 2, 1, 0, 3;
//   const auto [U, s, V] = svd(F);                    // F = U diag(s) V^T, of duals or of doubles
//
// Only for matrices of 2 by 2 and 3 by 3.
#pragma once

#include <Eigen/SVD>
#include <cmath>

#include "majorant/framework/terms/detail/element_term.h"

namespace majorant {

// Returns all entries of a vector as variables of differentiation, in their order.
template <int N>
Eigen::Vector<Dual2<double, N>, N> dual2_variables(const Eigen::Vector<double, N>& values) {
  Eigen::Vector<Dual2<double, N>, N> x;
  for (int k = 0; k < N; ++k) x[k] = Dual2<double, N>::variable(values[k], k);
  return x;
}
template <int N>
Eigen::Vector<Dual1<double, N>, N> dual1_variables(const Eigen::Vector<double, N>& values) {
  Eigen::Vector<Dual1<double, N>, N> x;
  for (int k = 0; k < N; ++k) x[k] = Dual1<double, N>::variable(values[k], k);
  return x;
}

// Returns the value of a number, or of each entry of a matrix, as a constant for derivatives.
inline double passive(double x) { return x; }
template <int N, int Order>
double passive(const Dual<double, N, Order>& x) {
  return x.v;
}
template <class Matrix>
auto passive(const Eigen::MatrixBase<Matrix>& x) {
  return x.unaryExpr([](const typename Matrix::Scalar& entry) { return passive(entry); }).eval();
}

// The decomposition A = U diag(s) V^T with rotations U and V: s_0 >= s_1 >= |s_2|, where the last
// has the sign of det A.
template <class T, int N>
struct SignedSvd {
  Eigen::Matrix<T, N, N> U;
  Eigen::Vector<T, N> s;
  Eigen::Matrix<T, N, N> V;
};

// Decomposes a matrix of doubles or of duals. Derivatives are exact up to rounding divided by the
// gaps between squares of singular values. If two singular values are equal, derivatives of U, V
// and s do not exist. Symmetric functions such as s_0 + s_1 and s_0 s_1 still have derivatives, but
// must be written without svd().
//
// For duals, a refinement that converges quadratically ([OA20]) starts from the decomposition of
// the values: its first round gives exact first derivatives, its second exact second derivatives.
template <class T, int N>
requires(N == 2 || N == 3) SignedSvd<T, N> svd(const Eigen::Matrix<T, N, N>& A) {
  const Eigen::Matrix<double, N, N> values = passive(A);
  const Eigen::JacobiSVD<Eigen::Matrix<double, N, N>, Eigen::NoQRPreconditioner> parts(
      values, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix<double, N, N> U = parts.matrixU(), V = parts.matrixV();
  if (U.determinant() < 0) U.col(N - 1) *= -1;
  if (V.determinant() < 0) V.col(N - 1) *= -1;
  const Eigen::Matrix<double, N, N> diagonal = U.transpose() * values * V;
  SignedSvd<T, N> svd{U.template cast<T>(), diagonal.diagonal().template cast<T>(),
                      V.template cast<T>()};
  if constexpr (std::is_same_v<T, double>) {
    return svd;
  } else {
    const Eigen::Matrix<T, N, N> one = Eigen::Matrix<double, N, N>::Identity().template cast<T>();
    for (int round = 0; round < T::order; ++round) {
      const Eigen::Matrix<T, N, N> R = one - svd.U.transpose() * svd.U,
                                   S = one - svd.V.transpose() * svd.V,
                                   M = svd.U.transpose() * A * svd.V;
      Eigen::Matrix<T, N, N> F, G;
      for (int i = 0; i < N; ++i) svd.s[i] = M(i, i) / (1.0 - 0.5 * (R(i, i) + S(i, i)));
      for (int i = 0; i < N; ++i)
        for (int j = 0; j < N; ++j) {
          if (i == j) {
            F(i, i) = 0.5 * R(i, i);
            G(i, i) = 0.5 * S(i, i);
            continue;
          }
          const T a = M(i, j) + svd.s[j] * R(i, j), b = M(j, i) + svd.s[j] * S(i, j);
          const T gap = svd.s[j] * svd.s[j] - svd.s[i] * svd.s[i];
          F(i, j) = (svd.s[j] * a + svd.s[i] * b) / gap;
          G(i, j) = (svd.s[i] * a + svd.s[j] * b) / gap;
        }
      svd.U = (svd.U + svd.U * F).eval();
      svd.V = (svd.V + svd.V * G).eval();
    }
    // The singular values of the last round's vectors.
    const Eigen::Matrix<T, N, N> last = svd.U.transpose() * A * svd.V;
    for (int i = 0; i < N; ++i) svd.s[i] = last(i, i);
    return svd;
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
