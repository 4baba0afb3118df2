// Moves a point until every element is proven positively oriented. It minimizes untangling energies
// (energies/untangling.h) by projected Newton steps while their eps shrinks, after [GKKPRS21].
//
//   const std::vector<TermId> terms;   // of the problem: those that untangle
//   const auto judge = [&](VecIn x) { return LocalInjectivity(space, 2 * rest.measure).check(x); };
//   UntangledPoint point = descend_untangling(problem, terms, judge, problem.reduce(start),
//                                             {.first_eps = kFirstEpsHeld}, stop);
//   if (point.verdict.feasible) std::cout << point.x;   // a start for minimizers
//
// The result is valid but not optimal, so it should be optimized afterwards. The descent may fail,
// since such a point need not exist.
#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "majorant/framework/feasibility.h"
#include "majorant/framework/problem.h"
#include "majorant/framework/stop_check.h"

namespace majorant {

// The first eps. If nothing holds the size of a map, an eps above 0.1 makes a collapsed map (2 /
// eps) as good as an isometry (4). A fixed boundary or two pins hold the size.
inline constexpr double kFirstEps = 0.1, kFirstEpsHeld = 1;

struct UntangledPoint {
  Vec x;               // full unknowns
  Verdict verdict;     // of x; margin: least bound of det J relative to the elements' sizes
  int iterations = 0;  // Newton steps
};

struct UntanglingRules {
  double first_eps = kFirstEps;
  int max_iterations = std::numeric_limits<int>::max();  // Newton steps; a round may exceed it
};

// Descends from y. energies: terms of the problem whose only parameter is eps. judge: checks all
// elements, on the full unknowns. The problem's own checkers must accept y. `stop` may end it
// early.
UntangledPoint descend_untangling(const Problem& problem, const std::vector<TermId>& energies,
                                  const std::function<Verdict(VecIn x)>& judge, Vec y,
                                  const UntanglingRules& rules, const StopCheck& stop);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
