// Finds the reason why there is no start or no step, as a sentence. It is called only after a
// failure, so it may take as long as an iteration, on one thread.
#pragma once

#include <string>

#include "majorant/framework/problem.h"

namespace majorant {

// Returns the reason why the energy is not finite at a point (full unknowns): "value is NaN in
// element 7 of term 'mine'".
std::string why_not_finite(const Problem& problem, VecIn x);

// Returns the reason why no Hessian of that model gave a direction at a point of finite energy.
std::string why_no_direction(Evaluator& evaluator, VecIn y, double energy, Curvature curvature);

// Returns "unbounded below: ..." if the energy falls faster and faster along its negative gradient,
// at all sampled distances and without an objection of a checker; otherwise an empty text.
std::string unbounded_along_gradient(Evaluator& evaluator, VecIn y, double energy);

// Returns "unbounded below: the energy falls to -1e+101".
std::string unbounded_below(double energy);
// Returns "unbounded below: the energy falls to -39.1 while the unknowns grow to 1e+17".
std::string falls_without_end(double energy, double norm);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
