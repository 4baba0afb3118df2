// The end of the examples about terms: prints the result beside the expected one.
#pragma once

#include <cmath>
#include <iostream>
#include <string_view>

#include "majorant/framework/minimizer.h"

// Says it, and gives main() its exit code: 0 where the solve converged and `value` is within
// `tolerance` of `expected`.
inline int outcome(const majorant::SolveResult& result, std::string_view what, double value,
                   double expected, double tolerance) {
  std::cout.precision(12);
  std::cout << majorant::status_name(result.status) << " in " << result.iterations.size()
            << " steps: " << what << " " << value << ", expected " << expected << "\n";
  const bool right = std::abs(value - expected) <= tolerance;
  return right && result.status == majorant::Status::Converged ? 0 : 1;
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
