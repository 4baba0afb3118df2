// Small symmetric matrices as local systems have them: packed lower triangles, row by row, entry
// (i, j), i >= j, at i (i + 1) / 2 + j.
//
//   double k[] = {2, 5, 2};        // [[2, 5], [5, 2]], eigenvalues 7 and -3
//   clamp_eigenvalues<2>(1, k);    // now 7 and 0
#pragma once

#include <Eigen/Eigenvalues>

namespace majorant {

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
