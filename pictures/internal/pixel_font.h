// Text in pictures of pixels: digits, small letters and a few signs, drawn for this.
#pragma once

#include <string_view>

#include "majorant/pictures/png_file.h"

namespace majorant {

// The size of a glyph at zoom 1, in pixels: from one character to the next, and of a line, 2 of
// them below the letters' foot.
inline constexpr int kGlyphAdvance = 6, kGlyphHeight = 9;

// Every dot of a letter zoom by zoom pixels, the upper left corner at (x, y); cut off at the edges.
// Other characters than those above are boxes.
void draw_text(PixelImage& image, int x, int y, int zoom, Color color, std::string_view text);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
