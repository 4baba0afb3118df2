// Descents within bounds by a barrier. The first descent ignores the bounds; if its minimum
// satisfies them, it is the constrained minimum. Otherwise BarrierMinimizer moves inside and
// follows the barrier.
#pragma once

#include "majorant/framework/run_record.h"
#include "majorant/parametrization/solve/internal/degree_problem.h"
#include "majorant/parametrization/solve/internal/stall_remedies.h"

namespace majorant {

// Descends to the documented stopping rules within the problem's bounds, with all remedies.
// Status::Infeasible if no point is found that satisfies them.
SolveResult descend_within_bounds(DegreeProblem& problem, RemedyState& state, RunRecord& record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
