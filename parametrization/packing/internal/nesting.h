// libnest2d: polygons slid along each other, by no-fit polygons.
//
//   const auto job = packing_job({map}, {AllowedRotations::Any}, 0.01);
//   const std::optional<Strip> nested = nested_strip(job, 2.5);    // 2.5 units wide
//
// Better than the raster for some layouts of few charts, and quadratic in their number. Polygons
// are the convex hulls of the outlines: the no-fit polygons of version 5 are right for convex ones
// alone, others it would let overlap without a word. So nothing is to be believed before it is
// proven. One thread, no clock: the same result every time.
#pragma once

#include "majorant/parametrization/packing/internal/placements.h"

namespace majorant {

// None where some do not fit, where libnest2d gives up, or where charts are fixed; without
// MAJORANT_GPL always: libnest2d is under the LGPL.
std::optional<Strip> nested_strip(const PackingJob& job, double width);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
