// One method on the problem of a comparison, every point of its way measured.
//
//   const Contest contest;
//   Comparison comparison;
//   warm_up(contest);
//   comparison.runs.push_back(race(*find_method("newton"), contest, 60));
#pragma once

#include "apps/compare/comparison.h"
#include "apps/compare/methods.h"

namespace majorant::app {

// time_limit: seconds of the method's own, without those of measuring.
MethodRun race(const Method& method, const Contest& contest, double time_limit);
// Runs two iterations: the first method would pay for waking threads and touching memory.
void warm_up(const Contest& contest);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
