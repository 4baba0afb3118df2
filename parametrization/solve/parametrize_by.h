// parametrize() by other rules than its own: for measurements of what a rule is worth, and for what
// solves on the way to a solve. A part of the facade: what it is made of does not include this.
#pragma once

#include "majorant/parametrization/solve/parametrize.h"
#include "majorant/parametrization/solve/pin_homotopy.h"
#include "majorant/parametrization/solve/solver_rules.h"

namespace majorant {

// Does what parametrize() does from a start, whose rules are SolverRules{}. record outlives the
// call.
ParametrizationResult parametrize_by(const SolverRules& rules, const BezierMap& start,
                                     const ParametrizationOptions& options, RunRecord& record);

// The solver that leads starts to their pins (pin_homotopy.h). record outlives it.
PinSolver pin_solver(RunRecord& record, const SolverRules& rules = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
