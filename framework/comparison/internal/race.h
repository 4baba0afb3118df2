// One method on a compared problem, every point of its way measured in the same way, whatever the
// method says of itself. The clock stands still while a point is measured.
#pragma once

#include "majorant/framework/comparison/compare.h"

namespace majorant {

// A run and the function that it ended on: the problem with barriers, multipliers and penalties as
// they were at the end, and y there. The problem of a run that has no end is the one it was given.
struct FinishedRun {
  MethodRun run;
  Problem problem;
  Vec y;
  bool has_end = false;
  Status status = Status::Failed;
  double gradient_norm = 0;  // at the end
};

// y0: of the method, full unknowns where there are manifolds.
FinishedRun race(const ComparisonMethod& method, const ComparedProblem& compared, const Vec& y0,
                 const ComparisonOptions& options);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
