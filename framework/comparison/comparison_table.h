// A comparison in one line per method: for a terminal, for other programs, and for the page that
// shows it (pictures/write_comparison.h).
//
//   const Comparison all = compare(problem, y0);
//   std::cout << comparison_table(all);
//   const std::string rows = comparison_rows_csv(all), points = comparison_points_csv(all);
#pragma once

#include <array>
#include <string>
#include <vector>

#include "majorant/framework/comparison/comparison.h"

namespace majorant {

// Relative distances from the best energy at which a method counts as arrived: 1 % and 0.01 %.
constexpr std::array<double, 2> kComparisonFractions = {1e-2, 1e-4};

// The columns of a row; "-" stands for a value that does not exist or was never reached.
struct ComparisonRow {
  std::string method, status, message;  // message: empty if it repeats the status
  std::string iterations, factorizations, seconds, assemble, factorize, solve, line_search;
  std::string energy, gradient_norm, measure;  // of the last point
  std::string distance;
  std::string excess;  // of the last energy, "1.3 %"
  std::array<std::string, kComparisonFractions.size()> iterations_to, seconds_to;
};

// One row per run, in order.
std::vector<ComparisonRow> comparison_rows(const Comparison& comparison);

// Returns the table for a terminal: aligned, in ASCII (other characters become '?'), with a line
// for each method and without empty columns. Lines "METHOD: MESSAGE" follow for every message and
// every note of a run, and "note: NOTE" for the notes on the problem. The text ends with a newline.
std::string comparison_table(const Comparison& comparison);

// Returns the numbers of the table as CSV, one line per method, under the header
//     method,status,iterations,factorizations,seconds,assemble,factorize,solve,line_search,
//     energy,gradient_norm,distance,definite,notes
// Numbers have the fewest digits that read back to the same double (inf, -inf and nan by name);
// texts are quoted as in RFC 4180 where they need it. Lines end with \n.
std::string comparison_rows_csv(const Comparison& comparison);
// Returns the points as CSV: a line for each iteration (0 is the start) of each method. The header
// is
//     method,iteration,seconds,energy,gradient_norm,step,MEASURE
// with the last column if the comparison has a measure.
std::string comparison_points_csv(const Comparison& comparison);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
