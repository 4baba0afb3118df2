// The letters of pictures of pixels: outlines that are part of the program, so that no font is
// looked for and pictures are the same on all machines.
#pragma once

#include <string_view>

#include "majorant/pictures/internal/drawing.h"

namespace majorant {

// The outlines of a line of text, its foot at (0, 0), letters of size 1, y down; a question mark
// for what is not ASCII.
Path text_outline(std::string_view text);
// How far the end of that line is.
double text_width(std::string_view text);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
