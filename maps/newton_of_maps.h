// Rules of Newton's method that were tuned on maps. Their energies are means over the surface and
// invariant under rotations, and their barriers keep Hessians away from singular ones.
//
//   const NewtonMinimizer newton(newton_of_maps());
//   const SolveResult result = newton.minimize(problem, y0, nullptr);
//
// Other energies use the defaults of NewtonOptions.
#pragma once

#include "majorant/framework/newton.h"

namespace majorant {

// Returns the stopping rules for a mean density of size about 1. If a certificate shortens steps to
// less than a tenth, the map moves into a corner, where remedies for stalls start badly. The result
// is therefore the point before.
inline StoppingRules stopping_of_maps() {
  StoppingRules rules;
  rules.scale = EnergyScale::Value;
  rules.second_chances = 0;
  rules.fallback_step = 0.1;  // tuned by bench/tune.py stopping.fallback_step
  rules.energy_scale = 1;
  return rules;
}

inline BlendRules blend_of_maps() {
  BlendRules rules;
  rules.misled_steps = 0;
  rules.shift = rotation_shift;
  return rules;
}

// Returns rules by which each step begins without a shift: if a Hessian is indefinite, it is that
// of a blend, whose weight rises before a shift is needed.
inline ShiftRules shifts_of_maps() {
  return {.least = kSmallestShift, .short_step = 0, .fall = 0, .wait = 0};
}

inline NewtonOptions newton_of_maps() {
  NewtonOptions options;
  options.blend = blend_of_maps();
  options.shifts = shifts_of_maps();
  options.stopping = stopping_of_maps();
  options.line_search = {};
  options.tests_minimum = false;  // maps have many minima, and a run ends at one of them
  return options;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
