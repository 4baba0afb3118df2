// Small symmetric matrices as local systems have them: packed lower triangles, row by row, entry
// (i, j), i >= j, at i (i + 1) / 2 + j.
//
//   double k[] = {2, 5, 2};        // [[2, 5], [5, 2]], eigenvalues 7 and -3
//   clamp_eigenvalues<2>(1, k);    // now 7 and 0
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace majorant {

// Pivots and columns below, in parts of the largest diagonal entry, are 0. Origin: 100 unit
// roundoffs, the rounding of a small factorization.
inline constexpr double kZeroPivot = 1e-14;

// Whether no eigenvalue is below 0, but for rounding, by a factorization: a fraction of the time
// that eigenvalues take. "No" may be caution.
template <int N>
bool is_semidefinite(const double* k) {
  double a[N][N], largest = 0;
  for (int i = 0, p = 0; i < N; ++i) {
    for (int j = 0; j <= i; ++j, ++p) a[i][j] = k[p];
    largest = std::max(largest, a[i][i]);
  }
  const double zero = kZeroPivot * largest;
  for (int c = 0; c < N; ++c) {
    if (!(a[c][c] >= -zero)) return false;  // NaN, too
    if (a[c][c] > zero) {
      const double inverse = 1 / a[c][c];
      for (int i = c + 1; i < N; ++i) {
        const double factor = a[i][c] * inverse;
        for (int j = c + 1; j <= i; ++j) a[i][j] -= factor * a[j][c];
      }
    } else {
      for (int i = c + 1; i < N; ++i)
        if (!(std::abs(a[i][c]) <= zero)) return false;
    }
  }
  return true;
}

// `clamp` of the negative eigenvalues taken away (BlendedCurvature::clamp), 1: set to 0; where one
// is not finite, the zero matrix. By an eigendecomposition: for N up to about 30.
template <int N>
void clamp_eigenvalues(double clamp, double* k) {
  using Matrix = Eigen::Matrix<double, N, N>;
  Matrix m;
  for (int i = 0, p = 0; i < N; ++i)
    for (int j = 0; j <= i; ++j, ++p) m(i, j) = m(j, i) = k[p];
  if (!m.allFinite()) {
    m.setZero();
  } else {
    const Eigen::SelfAdjointEigenSolver<Matrix> eigen(m);
    if (eigen.eigenvalues()[0] >= 0) return;
    m = eigen.eigenvectors() *
        eigen.eigenvalues().cwiseMax((1 - clamp) * eigen.eigenvalues()).asDiagonal() *
        eigen.eigenvectors().transpose();
  }
  for (int i = 0, p = 0; i < N; ++i)
    for (int j = 0; j <= i; ++j, ++p) k[p] = m(i, j);
}

}  // namespace majorant
