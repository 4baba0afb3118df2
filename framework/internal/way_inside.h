// Leads the start of a barrier method to where its bounds are met.
//
// Bounds that measure their violation (ViolationMeasure) are met by minima of it; with it whatever
// else the problem has is minimized, of a weight that falls with the margin: the penalty method of
// [NW06] Sec. 17.1. Other bounds are relaxed and tightened (enter_bounds()), and so are all where
// the minima take many steps.
#pragma once

#include <optional>

#include "majorant/framework/internal/barrier_run.h"

namespace majorant {

// The weight of the barriers that led inside, 0 where none was needed; nothing where the run has
// ended outside: run.result says why.
std::optional<double> lead_inside(BarrierRun& run);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
