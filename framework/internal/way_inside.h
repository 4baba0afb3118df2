// Leads the start of a barrier method into its bounds.
//
// Bounds that measure their violation (ViolationMeasure) are met by minimizing it. The rest of the
// problem is minimized with it, with a weight that falls with the margin: the penalty method of
// [NW06] Sec. 17.1. Other bounds are relaxed and tightened (enter_bounds()); so are all bounds if
// the minimization takes many steps.
#pragma once

#include <optional>

#include "majorant/framework/internal/barrier_run.h"

namespace majorant {

// Returns the weight of the barriers that led inside, 0 if the start was inside; nothing if the run
// ended outside, with the reason in run.result.
std::optional<double> lead_inside(BarrierRun& run);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
