// The functions of nesting.h in builds without libnest2d: pack() keeps the result of its raster.
#include "majorant/parametrization/packing/internal/nesting.h"

namespace majorant {

std::optional<Strip> nested_strip(const PackingJob&, double) { return std::nullopt; }

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
