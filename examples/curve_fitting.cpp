// Robust curve fitting: y = exp(m t + c) through samples of which every seventh is far off, by
// least squares with Cauchy's loss, and the same by Ceres, which ends at the same minimum.
#include <ceres/ceres.h>

#include "majorant/framework/newton.h"
#include "majorant/framework/terms/least_squares.h"
#include "outcome.h"
using namespace majorant;

int main() {
  // 1. The samples; each residual has the same two unknowns.
  Vec t = Vec::LinSpaced(70, 0, 5),
      y = (0.3 * t.array() + 0.1).exp() + 0.1 * (17 * t).array().sin();
  y(Eigen::seq(0, 69, 7)).array() += 4;
  const Cells both = Cells::Ones(70, 1) * Eigen::RowVector2i(0, 1);
  const auto residual = [&](Index i, const auto& p) { return exp(p[0] * t[i] + p[1]) - y[i]; };
  // 2. Ours.
  const auto fit = make_least_squares<2>("fit", both, residual, cauchy_loss(0.2));
  const Problem problem = ProblemBuilder(2).add(fit, 1).build();
  const SolveResult ours = NewtonMinimizer().minimize(problem, Vec::Zero(2), {});
  // 3. Theirs.
  Vec theirs = Vec::Zero(2);
  ceres::Problem blocks;
  for (Index i = 0; i < t.size(); ++i) {
    auto one = [&t, &y, i](const auto* p, auto* r) {
      return r[0] = exp(p[0] * t[i] + p[1]) - y[i], true;
    };
    auto* cost = new ceres::AutoDiffCostFunction<decltype(one), 1, 2>(new auto(one));
    blocks.AddResidualBlock(cost, new ceres::CauchyLoss(0.2), theirs.data());
  }
  ceres::Solver::Options options;
  options.function_tolerance = options.parameter_tolerance = options.gradient_tolerance = 1e-15;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &blocks, &summary);
  return outcome(ours, "energy", ours.energy, summary.final_cost, 1e-9);
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
