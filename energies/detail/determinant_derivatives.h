// The determinant of a 2 by 2 or 3 by 3 matrix F, row by row, and its derivatives: cofactors, and
// second derivatives as a packed lower triangle. Templates without includes, since kernels include
// this file.
//
//   double F[] = {2, 0, 0, 3}, g[4];
//   cofactors<2>(F, g);                          // 3, 0, 0, 2
#pragma once

namespace majorant {

template <int D, class T>
void cofactors(const T (&F)[D * D], T (&g)[D * D]) {
  static_assert(D == 2 || D == 3);
  if constexpr (D == 2) {
    g[0] = F[3];
    g[1] = -F[2];
    g[2] = -F[1];
    g[3] = F[0];
  } else {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const int a = 3 * ((i + 1) % 3), b = 3 * ((i + 2) % 3), c = (j + 1) % 3, d = (j + 2) % 3;
        g[3 * i + j] = F[a + c] * F[b + d] - F[a + d] * F[b + c];
      }
  }
}

template <int D, class T>
T determinant_of(const T (&F)[D * D]) {
  if constexpr (D == 2) {
    return F[0] * F[3] - F[1] * F[2];
  } else {
    T g[9];
    cofactors<3>(F, g);
    return F[0] * g[0] + F[1] * g[1] + F[2] * g[2];
  }
}

// Adds p times the second derivatives of det at F to k.
template <int D, class T>
void add_second_determinant(const T& p, const T (&F)[D * D], T (&k)[D * D * (D * D + 1) / 2]) {
  if constexpr (D == 2) {
    k[6] += p;  // entries (3, 0) and (2, 1)
    k[4] -= p;
  } else {
    for (int r = 0; r < 9; ++r)
      for (int q = 0; q < r; ++q) {
        const int i = r / 3, j = r % 3, m = q / 3, n = q % 3;
        if (i == m || j == n) continue;
        // Both entries are in the minor of the third row and column. Its sign is that of an even
        // permutation if both steps, from row to row and from column to column, have the same
        // cyclic direction.
        const int row = 3 - i - m, column = 3 - j - n;
        const bool alike = ((m - i + 3) % 3 == 1) == ((n - j + 3) % 3 == 1);
        const T term = p * F[3 * row + column];
        T& entry = k[r * (r + 1) / 2 + q];
        entry = alike ? entry + term : entry - term;
      }
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
