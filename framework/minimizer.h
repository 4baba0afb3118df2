// Iterative solvers: what they are given and what they return. Why they stop: stopping.h.
#pragma once

#include <string>
#include <vector>

#include "majorant/framework/problem.h"
#include "majorant/framework/run_record.h"
#include "majorant/framework/stopping.h"

namespace majorant {

struct SolveResult {
  Status status = Status::Failed;
  std::string message;
  Vec y;
  double energy = 0;
  double newton_decrement = 0;  // of the last step, an energy
  std::vector<IterationRecord> iterations;
  std::vector<Index> blocking;  // elements that limited the last step
};

class Minimizer {
 public:
  virtual ~Minimizer() = default;
  // y0: a feasible point of the reduced unknowns. observer: sees each step that is taken; may be
  // null. Never throws for numerical reasons.
  virtual SolveResult minimize(const Problem& problem, Vec y0, RunObserver* observer) const = 0;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
