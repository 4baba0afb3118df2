// What a picture of pixels says of its colours.
#pragma once

#include "majorant/pictures/internal/legend.h"
#include "majorant/pictures/png_file.h"

namespace majorant {

// Rows that a legend takes at the bottom of a picture of this width.
int png_legend_height(int width);

// Into those rows: as add_color_legend() of svg_legend.h, the lines of text below the bar.
void draw_legend(PixelImage& image, const Legend& legend);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
