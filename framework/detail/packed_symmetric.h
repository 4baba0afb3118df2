// Small symmetric matrices in the storage of local systems: packed lower triangles, row by row,
// entry (i, j), i >= j, at i (i + 1) / 2 + j.
//
//   double k[] = {2, 5, 2};        // [[2, 5], [5, 2]], eigenvalues 7 and -3
//   clamp_eigenvalues(2, 1, k);    // now 7 and 0
#pragma once

#include <algorithm>
#include <cmath>

namespace majorant {

// Pivots, and columns below them, count as 0 up to this part of the largest diagonal entry: 100
// unit roundoffs, the rounding of a small factorization.
inline constexpr double kZeroPivot = 1e-14;

// Returns whether no eigenvalue is negative beyond rounding, by a factorization, which takes a
// fraction of the time of eigenvalues. A semidefinite matrix may be refused.
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

// Removes the part `projection_weight` of each negative eigenvalue (as BlendedCurvature does; 1
// sets it to 0) by an eigendecomposition, for sizes up to about 30. If an entry is not finite, the
// result is the zero matrix.
void clamp_eigenvalues(int size, double projection_weight, double* k);

// Does the same by Jacobi's rotations, which are faster for N up to 4. Few rotations suffice if two
// blocks are coupled like the ends of a spring; rotations between the halves are tried first. A
// matrix without negative eigenvalues does not change.
template <int N>
void clamp_by_rotations(double projection_weight, double* k) {
  double a[N][N], v[N][N] = {}, largest = 0;
  for (int i = 0, p = 0; i < N; ++i) {
    v[i][i] = 1;
    for (int j = 0; j <= i; ++j, ++p) {
      a[i][j] = a[j][i] = k[p];
      largest = std::max(largest, std::abs(k[p]));
    }
  }
  const double zero = kZeroPivot * largest;
  const auto rotate = [&](int i, int j) {
    const double cotangent = (a[j][j] - a[i][i]) / (2 * a[i][j]);  // of twice the angle
    const double t = std::copysign(1.0, cotangent) /
                     (std::abs(cotangent) + std::sqrt(cotangent * cotangent + 1));
    const double c = 1 / std::sqrt(t * t + 1), s = t * c, moved = t * a[i][j];
    for (int m = 0; m < N; ++m) {
      const double x = a[m][i], y = a[m][j];
      a[m][i] = a[i][m] = c * x - s * y;
      a[m][j] = a[j][m] = s * x + c * y;
      const double p = v[m][i], q = v[m][j];
      v[m][i] = c * p - s * q;
      v[m][j] = s * p + c * q;
    }
    return moved;
  };
  for (bool done = false; !done;) {
    done = true;
    for (int step = 0; step + 1 < N; ++step) {
      const int apart = 1 + (N / 2 - 1 + step) % std::max(N - 1, 1);
      for (int i = 0; i + apart < N; ++i) {
        const int j = i + apart;
        if (!(std::abs(a[i][j]) > zero)) continue;
        const double low = a[i][i], high = a[j][j], moved = rotate(i, j);
        a[i][i] = low - moved;
        a[j][j] = high + moved;
        a[i][j] = a[j][i] = 0;
        done = false;
      }
    }
  }
  for (int e = 0; e < N; ++e)
    if (a[e][e] < 0)
      for (int i = 0, p = 0; i < N; ++i)
        for (int j = 0; j <= i; ++j, ++p) k[p] -= projection_weight * a[e][e] * v[i][e] * v[j][e];
}

// Makes a term's Hessian semidefinite like clamp_eigenvalues(), by the fastest method for N.
template <int N>
void make_semidefinite(double projection_weight, double* k) {
  // The size up to which rotations are faster: springs with 4 unknowns gain, bending with 6 does
  // not.
  constexpr int kFew = 4;
  if (is_semidefinite<N>(k)) return;
  bool finite = true;
  for (int p = 0; p < N * (N + 1) / 2; ++p) finite = finite && std::isfinite(k[p]);
  if (N <= kFew && finite)
    clamp_by_rotations<N>(projection_weight, k);
  else
    clamp_eigenvalues(N, projection_weight, k);
}

// Does the same for a size known at run time.
bool is_semidefinite(int size, const double* k);
void make_semidefinite(int size, double projection_weight, double* k);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
