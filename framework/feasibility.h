// What a line search must hold besides decreasing the energy.
//
// A checker sees the full unknowns x. It certifies: "feasible" is a proof (up to the documented
// model of arithmetic), "not feasible" may be mere caution.
#pragma once

#include <string_view>
#include <vector>

#include "majorant/framework/types.h"

namespace majorant {

struct Verdict {
  bool feasible = true;
  double margin = 0;            // checker's own measure, larger is safer
  std::vector<Index> blocking;  // elements that fail, in increasing order
};

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
  // checker that cannot certify paths returns s: its check() at the end point then decides.
  virtual StepBound max_step(VecIn x, VecIn d, double s) const = 0;
};

}  // namespace majorant
