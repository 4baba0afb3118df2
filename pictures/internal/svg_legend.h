// What a vector drawing says of its colours.
#pragma once

#include "majorant/pictures/internal/legend.h"
#include "majorant/pictures/internal/svg_layout.h"

namespace majorant {

inline constexpr double kSvgLegendHeight = 130.0;

// From this height on: the title, the bar with its ticks, pointed at ends that values are beyond,
// and the note, in letters for drawings that are shown small.
void add_color_legend(SvgLayout& layout, const Legend& legend, double top);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
