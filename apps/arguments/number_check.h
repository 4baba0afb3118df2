// Checks of numbers on the command line. CLI11's own range checks accept nan.
//
//   double soft = 1e3;
//   verb.add_option("--soft", soft, "...")->check(positive_number());
#pragma once

#include <CLI/App.hpp>
#include <limits>

namespace majorant::app {

// Accept finite numbers > 0, or >= 0, up to `most`.
CLI::Validator positive_number(double most = std::numeric_limits<double>::max());
CLI::Validator non_negative_number(double most = std::numeric_limits<double>::max());
// Accepts digits only, not 3.0, 1e3 or 0x3.
CLI::Validator whole_number(int least, int most = std::numeric_limits<int>::max());

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
