// Solves linear rows: expresses the unknowns that they determine by those that stay free.
//
//     const SolvedUnknowns solved = solve_rows(full_size, rows);   // as Elimination does
//
// The method is Gauss-Jordan, row by row. Rows of integers come first and are reduced over the
// rationals, so that their rank and consistency are decided without a tolerance. Rows with other
// coefficients follow, in doubles, each solved for its largest coefficient. Such a row depends on
// the rows before it if subtracting them leaves at most kFollows of the subtracted numbers. If it
// leaves more but less than kNearlyFollows, its rank cannot be decided, and the row is refused by
// name. A row x = number whose unknown occurs in no other row (a pin) skips all of this.
#pragma once

#include <map>
#include <unordered_map>
#include <vector>

#include "majorant/framework/constraint.h"
#include "majorant/framework/types.h"

namespace majorant {

// The error of a dependent row. For a coefficient it is relative to the largest product in its sum;
// for a dependent row of integers it is relative to the largest right-hand side. The value allows
// for thousands of roundings, whose number grows with the subtracted rows.
inline constexpr double kFollows = 1e-12;
// The square root of the unit roundoff: below it half of the digits are lost.
inline constexpr double kNearlyFollows = 1e-8;
// The residual of the right-hand side of a dependent row, relative to the largest numbers in it. It
// exceeds kFollows, because right-hand sides may already have lost digits in the caller.
inline constexpr double kSameTarget = 1e-9;

// An expression sum coefficient * x[unknown] + constant.
struct AffineExpression {
  std::map<Index, double> terms;
  double constant = 0;
};
struct SolvedUnknowns {
  // Flags by row_position(); fixed_to holds the value of an unknown that occurs in one row alone.
  std::vector<char> fixed;
  Vec fixed_to;
  std::unordered_map<Index, AffineExpression> others;
};

// Auxiliary unknowns are numbered after the full ones.
inline Index row_position(Index unknown, Index full_size) {
  return unknown >= 0 ? unknown : full_size - 1 - unknown;
}

// Returns the solved unknowns by row_position(). Throws Error(Unsupported), naming the rows, if
// they contradict each other, one nearly depends on others, or exact coefficients exceed 64 bits.
SolvedUnknowns solve_rows(Index full_size, const ConstraintRows& rows);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
