// Options of Ceres as an oracle: to the last digits, without messages.
#pragma once

#include <ceres/solver.h>

namespace majorant::test {

inline ceres::Solver::Options tight_options() {
  ceres::Solver::Options options;
  options.max_num_iterations = 1000;
  options.function_tolerance = options.gradient_tolerance = options.parameter_tolerance = 1e-16;
  options.logging_type = ceres::SILENT;
  return options;
}

}  // namespace majorant::test

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
