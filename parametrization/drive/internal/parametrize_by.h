// parametrize() by other rules than its own: for measurements of what a rule is worth.
#pragma once

#include "majorant/parametrization/drive/internal/solver_rules.h"
#include "majorant/parametrization/drive/parametrize.h"

namespace majorant {

// As parametrize() from a start; SolverRules{} are its rules. record outlives the call.
ParametrizationResult parametrize_by(const SolverRules& rules, const BezierMap& start,
                                     const ParametrizationOptions& options, RunRecord& record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
