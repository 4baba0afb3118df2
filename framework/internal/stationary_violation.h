// Distinguishes a minimum of a violation of constraints, at which a run may be called infeasible,
// from a point where a descent has merely become slow.
//
//     const double part = gradient_part(stage, {violation}, y);
//     const bool is_stationary = part <= kStationaryViolation;
//
// Not for minima of energies: the stopping rules (minimizer.h) find these.
#pragma once

#include <vector>

#include "majorant/framework/problem.h"

namespace majorant {

// The gradient of a violation counts as 0 up to this part of the gradients of its elements: they
// cancel to four digits.
inline constexpr double kStationaryViolation = 1e-4;
// The largest cost of the barriers at a minimum of the violation, as a part of the violation. The
// violation inside the barriers is at least the difference.
inline constexpr double kBarrierPart = 1e-2;

// Returns the norm of the gradient of the stage's energy by y, divided by the norm of the sum of
// the absolute gradients of all elements of the terms `violations`; 0 if these vanish.
double gradient_part(const Problem& stage, const std::vector<TermId>& violations, const Vec& y);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
