// A comparison in one line per method: the rows of the terminal's table and of the page's.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "apps/compare/comparison.h"

namespace majorant {

// Relative distances from the best energy that count as "there": 1 % and 0.01 %.
constexpr std::array<double, 2> kComparisonFractions = {1e-2, 1e-4};

// The columns of a row; "-" stands for what does not exist or was never reached.
struct ComparisonRow {
  std::string method, status, message;               // message: empty where it is the status again
  std::string iterations, seconds, energy, min_det;  // of the last point
  std::string excess;                                // of the last energy, "1.3 %"
  std::array<std::string, kComparisonFractions.size()> iterations_to, seconds_to;
};

// One row per run, in order.
std::vector<ComparisonRow> comparison_rows(const Comparison& comparison);

// The table for a terminal: aligned, ASCII (other characters become '?'), a line per method, then
// "METHOD: MESSAGE" for every run that has a message. Ends with a newline.
std::string comparison_table(const Comparison& comparison);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
