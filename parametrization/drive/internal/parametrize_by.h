// parametrize() by other rules than its own: for measurements of what a rule is worth, and for what
// solves on the way to a solve. A part of the facade: what it is made of does not include this.
#pragma once

#include "majorant/parametrization/drive/internal/reach_pins.h"
#include "majorant/parametrization/drive/internal/solver_rules.h"
#include "majorant/parametrization/drive/parametrize.h"

namespace majorant {

// As parametrize() from a start; SolverRules{} are its rules. record outlives the call.
ParametrizationResult parametrize_by(const SolverRules& rules, const BezierMap& start,
                                     const ParametrizationOptions& options, RunRecord& record);

// What leads starts to their pins (reach_pins.h). record outlives it.
PinSolver pin_solver(RunRecord& record, const SolverRules& rules = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
