// Checks of numbers on the command line, to be used instead of CLI11's, whose ranges let nan pass.
//
//   double soft = 1e3;
//   verb.add_option("--soft", soft, "...")->check(positive_number());
#pragma once

#include <CLI/App.hpp>
#include <limits>

namespace majorant::app {

// Finite and > 0, or >= 0, and at most so much.
CLI::Validator positive_number(double most = std::numeric_limits<double>::max());
CLI::Validator non_negative_number(double most = std::numeric_limits<double>::max());
// Digits alone: 3.0, 1e3 and 0x3 are none.
CLI::Validator whole_number(int least, int most = std::numeric_limits<int>::max());

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
