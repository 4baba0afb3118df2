// Matrices as libigl has them, of any scalar type and order, in; uv of the corners of faces out.
//
// Sample run:
//   example_eigen
#include "majorant/parametrization/adapters/eigen.h"

#include <iostream>

int main() {
  Eigen::MatrixXd V(6, 3);  // two squares at a right angle
  V << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 0, 0, 1, 1;
  Eigen::MatrixXi F(2, 4);  // quads
  F << 0, 1, 4, 2, 0, 2, 5, 3;
  const majorant::ParametrizationResult result = majorant::parametrize(V, F);
  std::cout << majorant::status_name(result.status) << ", energy " << result.measures.value << "\n";
  if (!result.map) return 1;
  std::cout << majorant::corner_uv(F, *result.map) << "\n";  // 8 by 2
  return result.measures.locally_injective ? 0 : 1;
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
