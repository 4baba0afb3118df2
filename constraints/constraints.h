// Constraints of maps, whole: what is eliminated exactly, and what every step must hold.
//
//   builder.add(std::make_shared<const LocalInjectivity>(space, 2 * rest.measure));
//
// Its headers:
//     fixed_points.h              nodes that stay where they are
//     fixed_unknowns.h            single unknowns with given values
//     axis_alignment.h            edges along the axes
//     seamless_constraint.h       both sides of a cut, alike up to a transition
//     local_injectivity.h         det J > 0, certified along whole steps
#pragma once

#include "majorant/constraints/axis_alignment.h"
#include "majorant/constraints/fixed_points.h"
#include "majorant/constraints/fixed_unknowns.h"
#include "majorant/constraints/local_injectivity.h"
#include "majorant/constraints/seamless_constraint.h"

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
