#include "majorant/framework/detail/packed_symmetric.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "majorant/framework/internal/symmetric_eigen.h"

namespace majorant {

void clamp_eigenvalues(int size, double projection_weight, double* k) {
  Eigen::MatrixXd m(size, size);
  for (int i = 0, p = 0; i < size; ++i)
    for (int j = 0; j <= i; ++j, ++p) m(i, j) = m(j, i) = k[p];
  if (!m.allFinite()) {
    std::fill_n(k, size * (size + 1) / 2, 0.0);
    return;
  }
  const SymmetricEigen eigen = symmetric_eigen(m);
  if (eigen.values[0] >= 0) return;
  const Vec clamped = eigen.values.cwiseMax((1 - projection_weight) * eigen.values);
  for (int i = 0, p = 0; i < size; ++i)
    for (int j = 0; j <= i; ++j, ++p) {
      double sum = 0;
      for (int e = 0; e < size; ++e) sum += clamped[e] * eigen.vectors(i, e) * eigen.vectors(j, e);
      k[p] = sum;
    }
}

bool is_semidefinite(int size, const double* k) {
  std::vector<double> a(k, k + size * (size + 1) / 2);
  const auto entry = [&](int i, int j) -> double& {
    return a[static_cast<std::size_t>(i * (i + 1) / 2 + j)];
  };
  double largest = 0;
  for (int i = 0; i < size; ++i) largest = std::max(largest, entry(i, i));
  const double zero = kZeroPivot * largest;
  for (int c = 0; c < size; ++c) {
    if (!(entry(c, c) >= -zero)) return false;  // NaN, too
    if (entry(c, c) > zero) {
      const double inverse = 1 / entry(c, c);
      for (int i = c + 1; i < size; ++i) {
        const double factor = entry(i, c) * inverse;
        for (int j = c + 1; j <= i; ++j) entry(i, j) -= factor * entry(j, c);
      }
    } else {
      for (int i = c + 1; i < size; ++i)
        if (!(std::abs(entry(i, c)) <= zero)) return false;
    }
  }
  return true;
}

void make_semidefinite(int size, double projection_weight, double* k) {
  if (!is_semidefinite(size, k)) clamp_eigenvalues(size, projection_weight, k);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
