// Problems of the collection [HS81] with equalities, inequalities and bounds, from its starts.
//
//   for (const CollectionProblem& p : collection()) {
//     const Instance i = p.make();
//     const BarrierResult result = i.minimize();      // result.energy against p.minimum
//   }
//
// Linear equalities are eliminated, bounds are Bounds, other constraints are equality() and
// inequality(). Left out are the problems with bounds only, and those that are discontinuous (87),
// defined by procedures (67, 85, 88 to 92), or need the error function (68, 69). 70, 105 and 115
// are not implemented.
#pragma once

#include <functional>
#include <vector>

#include "majorant/framework/barrier_minimizer.h"
#include "majorant/framework/problem.h"

namespace majorant::hock_schittkowski {

struct Instance {
  Problem problem;
  std::vector<HeldBound> bounds;
  Vec start;  // full unknowns, as published; those from `unknowns` on are fixed at 0
  int unknowns = 0;
  int equalities = 0, linear_equalities = 0, inequalities = 0, finite_bounds = 0;

  BarrierResult minimize(const BarrierOptions& options = {}) const;
  // Returns the least value of inequalities and distances to bounds at full unknowns x; +inf
  // without any.
  double margin(VecIn x) const;
};

struct CollectionProblem {
  int number;
  double minimum;  // published; with more digits if the publication has few
  std::function<Instance()> make;
  // Other local minima that runs from the published start reach. SLSQP of scipy finds them, too,
  // from the same start except for problem 97. The minimum of problem 109 is below the published
  // one.
  std::vector<double> local_minima = {};
};

// The problems of each file, in the order of their numbers.
std::vector<CollectionProblem> problems_6_to_24();
std::vector<CollectionProblem> problems_26_to_50();
std::vector<CollectionProblem> problems_51_to_81();
std::vector<CollectionProblem> problems_83_to_119();
const std::vector<CollectionProblem>& collection();

}  // namespace majorant::hock_schittkowski

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
