// The text of the legend of a coloured map, however it is drawn.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "majorant/maps/map_file.h"
#include "majorant/pictures/color_scale.h"
#include "majorant/pictures/internal/claimed_energy.h"

namespace majorant {

struct Legend {
  ColorScale scale;
  // ASCII, including the name of the energy.
  std::string title;
  std::string note;                             // clauses, separated by "; "
  std::size_t note_lines = 1;                   // minimal number of lines reserved for the note
  bool goes_below = false, goes_above = false;  // whether values are beyond the ends
};

// Returns the scale of a quantity (for densities, of this energy) with the requested range. Throws
// the Error(Usage) of ColorScale, naming --color-range, and for a density without a claimed energy.
ColorScale picture_scale(const ClaimedEnergy& energy, Quantity quantity,
                         const std::optional<ColorRange>& range);

// Statistics of the values shown as colours.
struct ValueSummary {
  std::int64_t count = 0, below = 0, above = 0;  // relative to the scale

  void add(const ColorScale& scale, double value);
  void add(const ValueSummary& other);
};

// Returns "; smallest 4, largest 12.5 (45 points a face)": extremes over the whole map at
// extreme_samples() of its faces, as in reports, whatever is drawn. Flat and turned-over faces are
// excluded. Empty if none is left.
std::string extremes_clause(const MapFile& map, Quantity quantity, const ClaimedEnergy& energy);
// Returns "; 2 of 100 triangle means below 4.5; 1 of ..." for values beyond the ends of the scale.
// parts: the coloured parts, "triangle means".
std::string beyond_clauses(const ColorScale& scale, const ValueSummary& values,
                           const std::string& parts);

// Returns the legend of a scale alone: the quantity and the isometry.
Legend scale_legend(Quantity quantity, const ColorScale& scale, const ClaimedEnergy& energy);
// Returns the legend of one map, with its degree and extremes.
Legend make_legend(const MapFile& map, Quantity quantity, const ColorScale& scale);
// Returns the legend with the number of values beyond its ends.
Legend with_values(const Legend& legend, const ValueSummary& values, const std::string& parts);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
