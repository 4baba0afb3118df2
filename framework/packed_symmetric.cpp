#include "majorant/framework/detail/packed_symmetric.h"

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

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
