// Tells a minimum of a violation of constraints, at which a run may be called infeasible, from a
// point where a descent has merely become slow.
//
//     const double part = gradient_part(stage, {violation}, y);
//     const bool is_stationary = part <= kStationaryViolation;
//
// Not for minima of energies: the stopping rules (minimizer.h) tell these.
#pragma once

#include <vector>

#include "majorant/framework/problem.h"

namespace majorant {

// The largest gradient of a violation, as a part of the gradients of its elements, that counts as
// 0: they cancel to four digits.
inline constexpr double kStationaryViolation = 1e-4;
// The largest cost of the barriers beside a violation at its minimum, as a part of it: the
// violation inside the barriers is at least the rest.
inline constexpr double kBarrierPart = 1e-2;

// The norm of the gradient of the stage's energy by y, as a part of that of the sum of the absolute
// values of the gradients of all elements of the terms `violations`; 0 where these vanish.
double gradient_part(const Problem& stage, const std::vector<TermId>& violations, const Vec& y);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
