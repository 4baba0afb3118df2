// Packing by libnest2d, which slides polygons along each other by no-fit polygons.
//
//   const auto job = packing_job({map}, {AllowedRotations::Any}, 0.01);
//   const std::optional<Strip> nested = nested_strip(job, 2.5);    // 2.5 units wide
//
// It is better than the raster for some layouts of few charts, and quadratic in their number.
// Polygons are the convex hulls of the outlines: the no-fit polygons of version 5 are correct for
// convex polygons only and would silently let others overlap, so the result must be proven. One
// thread, no clock: the result is always the same.
#pragma once

#include "majorant/parametrization/packing/internal/placements.h"

namespace majorant {

// Returns none if some charts do not fit, if libnest2d gives up, if charts are fixed, or always
// without MAJORANT_GPL: libnest2d is under the LGPL.
std::optional<Strip> nested_strip(const PackingJob& job, double width);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
