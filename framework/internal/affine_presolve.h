// Linear rows solved: which unknowns they determine, as affine expressions of those that stay free.
//
//     const SolvedUnknowns solved = solve_rows(full_size, rows);   // what Elimination is made of
//
// Gauss-Jordan, row by row. Rows of integers come first and are reduced over the rationals, so that
// their rank and their consistency are decided without a tolerance, whatever else is there. Rows
// with other coefficients follow, in doubles, each solved for its largest coefficient. Such a row
// follows from those before it where subtracting them leaves no more than kFollows of what was
// subtracted; where it leaves more but less than kNearlyFollows, nobody can tell, and it is
// refused by name. A row x = number whose unknown no other row has (a pin, most often: thousands of
// them) takes part in none of this.
#pragma once

#include <map>
#include <unordered_map>
#include <vector>

#include "majorant/framework/constraint.h"
#include "majorant/framework/types.h"

namespace majorant {

// The error of a row of integers that follows from others, relative to the largest product that a
// coefficient is a sum of, and to the largest right-hand side. Thousands of roundings, whose number
// grows with the rows that are subtracted.
inline constexpr double kFollows = 1e-12;
// Below the square root of the unit roundoff half of the digits are lost.
inline constexpr double kNearlyFollows = 1e-8;
// The residual of a row that follows from others, relative to the largest numbers in it. Larger
// than kFollows by the digits that right-hand sides may have lost before they came here.
inline constexpr double kSameTarget = 1e-9;

// sum coefficient * x[unknown] + constant.
struct AffineExpression {
  std::map<Index, double> terms;
  double constant = 0;
};
struct SolvedUnknowns {
  // Flags by row_position(): fixed_to holds the value of an unknown that one row alone fixes.
  std::vector<char> fixed;
  Vec fixed_to;
  std::unordered_map<Index, AffineExpression> others;
};

// Auxiliary unknowns are numbered after the full ones.
inline Index row_position(Index unknown, Index full_size) {
  return unknown >= 0 ? unknown : full_size - 1 - unknown;
}

// Returns the solved unknowns by row_position(). Throws Error(Unsupported), naming rows, where they
// contradict each other, one nearly follows from others, or exact coefficients leave 64 bits.
SolvedUnknowns solve_rows(Index full_size, const ConstraintRows& rows);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
