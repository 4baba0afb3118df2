// The methods of Ceres for compare(), for programs that link majorant::ceres.
//
//   const Comparison all = compare(problem, y0, comparison_methods(ceres_methods()));
//
// Not for a single solve: CeresMinimizer (ceres_minimizer.h) does that. Nonlinear conjugate
// gradients are left out, because Ceres writes each of their restarts to stderr.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "majorant/framework/ceres_minimizer.h"
#include "majorant/framework/comparison/methods.h"

namespace majorant {

inline std::vector<ComparisonMethod> ceres_methods() {
  using enum CeresOptions::Method;
  const auto method = [](std::string name, std::string summary, CeresOptions::Method own) {
    const bool is_of_squares = own == LevenbergMarquardt || own == Dogleg;
    return free_method(
        std::move(name), std::move(summary),
        [own](const ComparedProblem&, const MethodLimits& limits) {
          CeresOptions options;
          options.method = own;
          if (limits.max_iterations) options.max_iterations = *limits.max_iterations;
          options.stop = limits.stop;
          return std::make_unique<CeresMinimizer>(options);
        },
        is_of_squares ? squares_obstacle : nullptr);
  };
  return {method("ceres-lbfgs", "Ceres, L-BFGS", Lbfgs),
          method("ceres-lm", "Ceres, Levenberg-Marquardt", LevenbergMarquardt),
          method("ceres-dogleg", "Ceres, dogleg", Dogleg)};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
