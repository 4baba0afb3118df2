// parametrize() with other rules than its own, for measurements and for auxiliary solves. It is
// part of the facade: the implementation below it does not include this file.
#pragma once

#include "majorant/parametrization/solve/parametrize.h"
#include "majorant/parametrization/solve/pin_homotopy.h"
#include "majorant/parametrization/solve/solver_rules.h"

namespace majorant {

// Does what parametrize() does from a start; parametrize() uses SolverRules{}. record outlives the
// call.
ParametrizationResult parametrize_by(const SolverRules& rules, const BezierMap& start,
                                     const ParametrizationOptions& options, RunRecord& record);

// Returns the solver that moves starts to their pins (pin_homotopy.h). record outlives it.
PinSolver pin_solver(RunRecord& record, const SolverRules& rules = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
