// A run of a barrier method: its problem, its rules, and its result so far.
#pragma once

#include <limits>
#include <string>

#include "majorant/framework/barrier_minimizer.h"
#include "majorant/framework/barrier_path.h"

namespace majorant {

struct BarrierRun {
  BarrierRun(BarrierProblem& on, const BarrierOptions& rules);

  // Returns the scale for comparisons with |E|.
  double energy_scale() const;
  // Returns the stage of the bounds themselves, with one weight for all barriers.
  BarrierStage of_bounds(double mu) const;
  // Returns the first weight of the barriers of a stage; 0 if there are none.
  double first_weight(const BarrierStage& stage);
  // Enters a stage. Returns whether a descent can begin there.
  bool starts(const BarrierStage& stage);
  // Descends from the present point by at most most_iterations, and returns the number of
  // iterations.
  int descend(StoppingRules rules, int most_iterations = std::numeric_limits<int>::max());
  bool went_on() const;
  void return_to(const BarrierProblem::Place& place);
  // The run ends without what it has looked for.
  void refuse(Status status, std::string why);

  BarrierProblem& problem;
  const BarrierOptions& options;
  HeldBounds bounds;
  BarrierResult result;
  double barrier_size = 0;  // m: BarrierProblem::barrier_size()
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
