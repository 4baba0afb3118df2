// Values of a term element by element, outside of any problem: who contributes how much.
//
//   const ChunkPlan plan(energy->stencils(), {});   // all elements on the first rule
//   const Vec values = element_values(*energy, {}, plan, x);
#pragma once

#include "majorant/framework/energy_term.h"
#include "majorant/framework/internal/chunk_plan.h"
#include "majorant/framework/stop_check.h"

namespace majorant {

// Unweighted value of each element of a term at x, with the plan that belongs to `state`. Polls
// between chunks of elements, as all evaluations do that are given a stop check: Stopped.
Vec element_values(const EnergyTerm& term, const TermState& state, const ChunkPlan& plan, VecIn x,
                   const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
