// The start of a degree moved onto constraints that it does not satisfy, as smoothly as they allow:
// a translation costs nothing, and what one point must move its neighbours share.
//
//     x = meet_constraints(problem, *space, x);   // minimizes |grad (x - start)|^2, discretely
//
// Nothing is known of injectivity afterwards: check it.
#pragma once

#include "majorant/elements/bezier_triangle_space.h"
#include "majorant/framework/problem.h"

namespace majorant {

// x: full unknowns, the nodes of `space` first; what follows them stays as close as it can. The
// same where x satisfies the constraints to rounding.
Vec meet_constraints(const Problem& problem, const BezierTriangleSpace& space, VecIn x);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
