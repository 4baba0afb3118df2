// The text of the legend of a coloured map, however it is drawn.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "majorant/parametrization/maps/map_file.h"
#include "majorant/pictures/color_scale.h"

namespace majorant {

struct Legend {
  ColorScale scale;
  // One line each, ASCII; what the energy was called included.
  std::string title;
  std::vector<std::string> notes;               // lines, one unless wrapped
  bool goes_below = false, goes_above = false;  // values are beyond the ends
};

// The scale of a quantity of this map, with the range that was asked for. Throws Error(Usage) as
// ColorScale does, naming --color-range, and for a density whose energy the claims do not name.
ColorScale picture_scale(const MapFile& map, Quantity quantity,
                         const std::optional<ColorRange>& range);

// Values that are shown as colours.
struct ValueSummary {
  std::int64_t count = 0, below = 0, above = 0;  // of the scale

  void add(const ColorScale& scale, double value);
  void add(const ValueSummary& other);
};

// The smallest and the largest value that the note names are those of the whole map at
// extreme_samples() of its faces, as in reports, whatever is drawn; turned over and flat faces left
// out. parts: what the colours are of, "triangles".
Legend make_legend(const MapFile& map, Quantity quantity, const ColorScale& scale,
                   const ValueSummary& values, const std::string& parts);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
