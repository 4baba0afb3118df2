// Leads a point to where every element is proven to be positively oriented: minimizes untangling
// energies (energies/untangling.h) by projected Newton while their eps shrinks, after [GKKPRS21].
//
//   const std::vector<TermId> terms;   // of the problem: those that untangle
//   const auto judge = [&](VecIn x) { return LocalInjectivity(space, 2 * rest.measure).check(x); };
//   UntangledPoint point = descend_untangling(problem, terms, judge, problem.reduce(start),
//                                             {.first_eps = kFirstEpsHeld}, stop);
//   if (point.verdict.feasible) std::cout << point.x;   // a start for minimizers
//
// What it reaches is valid, not good: optimize it afterwards. It may fail: there may be no such
// point.
#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "majorant/framework/feasibility.h"
#include "majorant/framework/problem.h"
#include "majorant/framework/stop_check.h"

namespace majorant {

// The eps to begin with: where nothing holds the size of a map, a larger one than 0.1 makes
// collapse (2 / eps for a map shrunk to a point) as good as an isometry (4). A fixed boundary or
// two pins hold it.
inline constexpr double kFirstEps = 0.1, kFirstEpsHeld = 1;

struct UntangledPoint {
  Vec x;               // full unknowns
  Verdict verdict;     // of x; its margin: the least bound of det J, by the size of the elements
  int iterations = 0;  // Newton steps
};

struct UntanglingRules {
  double first_eps = kFirstEps;
  int max_iterations = std::numeric_limits<int>::max();  // Newton steps, up to a round of eps more
};

// energies: terms of the problem whose one parameter is eps. judge: the checks of all elements, on
// the full unknowns; the problem has no checker of its own that y does not meet. Ends early when
// `stop` says so.
UntangledPoint descend_untangling(const Problem& problem, const std::vector<TermId>& energies,
                                  const std::function<Verdict(VecIn x)>& judge, Vec y,
                                  const UntanglingRules& rules, const StopCheck& stop);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
