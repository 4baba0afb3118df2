// Runs one method on a compared problem. Every point of the run is measured by the same code,
// whatever the method reports, and the clock stands still meanwhile.
#pragma once

#include "majorant/framework/comparison/compare.h"

namespace majorant {

// A run and its final function: the problem with the barriers, multipliers and penalties of the
// end, and y at the end. A run without an end keeps the problem that it was given.
struct FinishedRun {
  MethodRun run;
  Problem problem;
  Vec y;
  bool has_end = false;
  Status status = Status::Failed;
  double gradient_norm = 0;  // at the end
};

// y0: the start in the unknowns of the method; the full unknowns if there are manifolds.
FinishedRun race(const ComparisonMethod& method, const ComparedProblem& compared, const Vec& y0,
                 const ComparisonOptions& options);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
