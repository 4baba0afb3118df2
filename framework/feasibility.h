// What a line search must hold besides decreasing the energy.
//
// A checker sees the full unknowns x. It certifies: "feasible" is a proof (up to the documented
// model of arithmetic), "not feasible" may be mere caution. A checker is immutable and called from
// several threads: what it did it returns, and who asks adds it up (Evaluator::violation).
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "majorant/framework/types.h"

namespace majorant {

struct Verdict {
  bool feasible = true;
  double margin = 0;            // checker's own measure, larger is safer
  std::vector<Index> blocking;  // elements that fail, in increasing order
  // Elements proven by depth of bisection; empty for checkers that do not bisect.
  std::vector<long> proven;
};

// Entry by entry; either may have fewer of them.
inline void add_counts(std::vector<long>& sum, const std::vector<long>& more) {
  if (sum.size() < more.size()) sum.resize(more.size());
  for (std::size_t k = 0; k < more.size(); ++k) sum[k] += more[k];
}

struct StepBound {
  double step = 0;              // largest certified step
  std::vector<Index> blocking;  // elements that admit at most twice as much; empty: unrestricted
};

class FeasibilityChecker {
 public:
  virtual ~FeasibilityChecker() = default;
  virtual std::string_view name() const = 0;
  virtual Verdict check(VecIn x) const = 0;
  // Largest s' <= s such that x + t d is feasible for all 0 <= t < s', given that x is feasible. A
  // checker that cannot certify paths returns s: its check() at the end point then decides. Solvers
  // throw InvalidArgument, with the name, for an answer that is negative or NaN.
  virtual StepBound max_step(VecIn x, VecIn d, double s) const = 0;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
