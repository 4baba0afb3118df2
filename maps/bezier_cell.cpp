#include "majorant/maps/bezier_cell.h"

#include <cmath>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

int bezier_cell_degree(long long size) {
  for (int degree = 1; degree <= kHighestFileDegree; ++degree) {
    if (bezier_cell_size(degree) == size) return degree;
  }
  return 0;
}

std::vector<std::array<int, 3>> bezier_multi_indices(int degree) {
  std::vector<std::array<int, 3>> result;
  for (int shift = 0; degree >= 0; ++shift, degree -= 3) {  // one ring of the triangle at a time
    const auto add = [&](int i, int j, int k) {
      result.push_back({i + shift, j + shift, k + shift});
    };
    add(degree, 0, 0);
    if (degree == 0) break;
    add(0, degree, 0);
    add(0, 0, degree);
    for (int s = 1; s < degree; ++s) add(degree - s, s, 0);
    for (int s = 1; s < degree; ++s) add(0, degree - s, s);
    for (int s = 1; s < degree; ++s) add(s, 0, degree - s);
  }
  return result;
}

std::vector<int> bezier_edge_points(int degree, int edge) {
  std::vector<int> result = {edge};
  for (int s = 0; s < degree - 1; ++s) result.push_back(3 + edge * (degree - 1) + s);
  result.push_back(next(edge));
  return result;
}

Eigen::MatrixXd bernstein_values(int degree, const Points3& barycentric) {
  const auto indices = bezier_multi_indices(degree);
  Eigen::MatrixXd values(barycentric.rows(), static_cast<Eigen::Index>(indices.size()));
  std::vector<double> factorial(to_size(degree) + 1, 1.0);
  for (std::size_t k = 1; k < factorial.size(); ++k) {
    factorial[k] = factorial[k - 1] * static_cast<double>(k);
  }
  for (Eigen::Index p = 0; p < values.cols(); ++p) {
    const auto& index = indices[static_cast<std::size_t>(p)];
    double coefficient = factorial.back();
    for (const int i : index) coefficient /= factorial[i];
    for (Eigen::Index s = 0; s < values.rows(); ++s) {
      double value = coefficient;
      for (int c = 0; c < 3; ++c) {
        value *= std::pow(barycentric(s, c), index[c]);
      }
      values(s, p) = value;
    }
  }
  return values;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
