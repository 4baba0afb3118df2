// The sheet of examples/cloth.cpp in Ceres, with springs and angles as residuals and blocks of
// three unknowns.
//
// Sample run:
//   build/release/bench/cloth_ceres
#include <ceres/ceres.h>

#include <iostream>

#include "../examples/cloth.h"

struct Spring {
  double L;
  template <class T>
  bool operator()(const T* a, const T* b, T* r) const {
    using V = Eigen::Map<const Eigen::Matrix<T, 3, 1>>;
    r[0] = ((V(b) - V(a)).norm() - L) / std::sqrt(L);
    return true;
  }
};

struct Hinge {
  template <class T>
  bool operator()(const T* a, const T* b, const T* c, const T* d, T* r) const {
    using V = Eigen::Map<const Eigen::Matrix<T, 3, 1>>;
    const auto edge = (V(b) - V(a)).eval();
    const auto left = edge.cross(V(c) - V(a)).eval(), right = (V(d) - V(a)).cross(edge).eval();
    r[0] = std::sqrt(0.001) * atan2(left.cross(right).dot(edge) / edge.norm(), left.dot(right));
    return true;
  }
};

int main() {
  Cloth sheet = cloth(60);
  const auto at = [&](majorant::Index p) { return sheet.start.row(p).data(); };
  ceres::Problem problem;
  for (const auto& e : sheet.edges.rowwise()) {
    const double L = (sheet.flat.row(e[0]) - sheet.flat.row(e[1])).norm();
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Spring, 1, 3, 3>(new Spring{L}),
                             nullptr, at(e[0]), at(e[1]));
  }
  for (const auto& h : sheet.hinges.rowwise())
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Hinge, 1, 3, 3, 3, 3>(new Hinge),
                             nullptr, at(h[0]), at(h[1]), at(h[2]), at(h[3]));
  for (const majorant::Index p : sheet.held) problem.SetParameterBlockConstant(at(p));
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.function_tolerance = options.parameter_tolerance = options.gradient_tolerance = 1e-12;
  options.max_num_iterations = 1000;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  std::cout.precision(12);
  std::cout << (summary.termination_type == ceres::CONVERGENCE ? "converged" : "not converged")
            << " in " << summary.iterations.size() - 1 << " steps: energy "
            << 2 * summary.final_cost << "\n";
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
