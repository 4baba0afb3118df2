// The letters of pixel pictures: built-in outlines, so that no font is needed and pictures are
// equal on all machines.
#pragma once

#include <string_view>

#include "majorant/pictures/internal/drawing.h"

namespace majorant {

// Returns the outlines of a line of text at size 1, with its baseline at (0, 0), y down. Characters
// beyond ASCII become question marks.
Path text_outline(std::string_view text);
// Returns the width of that line.
double text_width(std::string_view text);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
