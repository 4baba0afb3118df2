#include "majorant/framework/internal/singular_matrix.h"

#include <cmath>
#include <random>

namespace majorant {
namespace {

// A matrix scaled to diagonal 1 counts as singular if it has an eigenvalue below this.
constexpr double kSingular = 1e-13;

}  // namespace

bool is_singular(LinearSolver& solver, const SparsePattern& pattern, const Vec& values) {
  std::minstd_rand random(1);
  Vec v(pattern.size), roots(pattern.size), next;
  for (double& entry : v)
    entry = std::sqrt(12.0) * (static_cast<double>(random()) / std::minstd_rand::max() - 0.5);
  for (Index i = 0; i < pattern.size; ++i)
    roots[i] = std::sqrt(std::abs(values[pattern.diagonal_slot(i)]));
  const auto size_of_solution = [&] {
    solver.solve(roots.cwiseProduct(v), next);
    next = next.cwiseProduct(roots);
    return next.norm();
  };
  if (size_of_solution() * kSingular < 1) return false;
  v = next.normalized();
  return !(size_of_solution() * kSingular < 1);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
