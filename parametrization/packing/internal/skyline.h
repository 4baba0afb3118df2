// Packing of boxes on shelves: every chart's box is put at the lowest place that is open from above
// ([Jyl10] Sec. 2.4), in the first tile where it fits. Other packers are measured against it.
// O(#charts * #steps of the line).
#pragma once

#include "majorant/parametrization/packing/internal/placements.h"

namespace majorant {

// Returns the lower of two strips: boxes upright, and boxes lying.
std::optional<Strip> skyline_strip(const PackingJob& job, double width);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
