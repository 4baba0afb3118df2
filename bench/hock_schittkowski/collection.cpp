#include "collection.h"

#include <algorithm>
#include <limits>

namespace majorant::hock_schittkowski {

BarrierResult Instance::minimize(const BarrierOptions& options) const {
  const BarrierMinimizer minimizer = bounds.empty()
                                         ? BarrierMinimizer({}, options)
                                         : BarrierMinimizer::of_bounds(bounds, {}, options);
  return minimizer.run(problem, problem.reduce(start));
}

double Instance::margin(VecIn x) const {
  double least = std::numeric_limits<double>::infinity();
  for (const HeldBound& held : bounds) least = std::min(least, held.bound->check(x).margin);
  return least;
}

const std::vector<CollectionProblem>& collection() {
  static const std::vector<CollectionProblem> all = [] {
    std::vector<CollectionProblem> problems;
    for (const auto& part :
         {problems_6_to_24(), problems_26_to_50(), problems_51_to_81(), problems_83_to_119()})
      problems.insert(problems.end(), part.begin(), part.end());
    return problems;
  }();
  return all;
}

}  // namespace majorant::hock_schittkowski

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
