// Bounds with a barrier: first a descent as if there were none; where the free minimum meets them,
// it is the constrained one. Else BarrierMinimizer leads inside and along the barrier.
#pragma once

#include "majorant/framework/run_record.h"
#include "majorant/parametrization/solve/internal/degree_problem.h"
#include "majorant/parametrization/solve/internal/stall_remedies.h"

namespace majorant {

// The problem has bounds. Descends to the documented stopping rules within them, with all remedies;
// Status::Infeasible where no point is found that meets them.
SolveResult descend_within_bounds(DegreeProblem& problem, RemedyState& state, RunRecord& record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
