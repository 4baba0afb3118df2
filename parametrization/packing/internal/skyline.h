// Boxes on shelves: every chart's box at the lowest place that the boxes before it leave open from
// above ([Jyl10] Sec. 2.4), in the first tile where it fits. What any better packer must beat;
// O(#charts * #steps of the line).
#pragma once

#include "majorant/parametrization/packing/internal/placements.h"

namespace majorant {

// The lower of two: boxes upright, boxes lying.
std::optional<Strip> skyline_strip(const PackingJob& job, double width);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
