// What all pictures of a map can be told.
#pragma once

#include <optional>

#include "majorant/pictures/color_scale.h"

namespace majorant {

// Whether pictures and pages show the layout turned, the longer side of the smallest rectangle
// around it lying. Automatic: where nothing holds it as it is, as far as the map's claims tell: no
// pins, handles, seams or charts, and it is not a deformation. Files keep their coordinates either
// way.
enum class Alignment { Automatic, Always, Never };

struct ColorRange {
  double low = 0, high = 1;  // as ColorScale::with_range() has them
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
