// The values of a term, element by element, outside of any problem.
//
//   const ColoredBatches plan(energy->element_dofs(), {});   // all elements on the first rule
//   const Vec values = element_values(*energy, {}, plan, x);
//   const std::vector<Index> some{7, 3};
//   const Vec two = element_values(*energy, {}, 0, some, x);   // of elements 7 and 3
#pragma once

#include <span>

#include "majorant/framework/energy_term.h"
#include "majorant/framework/internal/colored_batches.h"
#include "majorant/framework/stop_check.h"

namespace majorant {

// Returns the unweighted value of each element of a term at x, with the plan that belongs to
// `state`. Polls `stop` between batches of elements and throws Stopped.
Vec element_values(const EnergyTerm& term, const TermState& state, const ColoredBatches& plan,
                   VecIn x, const StopCheck& stop = {});
// Returns the values of `elements`, all by the given rule, whatever rules `state` has. It makes no
// plan, which costs more than it saves for one evaluation or for few elements.
Vec element_values(const EnergyTerm& term, const TermState& state, RuleId rule,
                   std::span<const Index> elements, VecIn x, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
