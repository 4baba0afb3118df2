// The singular values of a 2 by 2 matrix, computed without squares of its entries.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <utility>

namespace majorant {

// Returns the larger one, and the smaller one with the sign of det J: alpha + beta and alpha -
// beta, where alpha and beta are the absolute values of the conformal and the anticonformal part.
inline std::pair<double, double> singular_values(const Eigen::Matrix2d& J) {
  const double alpha = 0.5 * std::hypot(J(0, 0) + J(1, 1), J(1, 0) - J(0, 1));
  const double beta = 0.5 * std::hypot(J(0, 0) - J(1, 1), J(1, 0) + J(0, 1));
  return {alpha + beta, alpha - beta};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
