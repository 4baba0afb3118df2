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
  // ASCII; what the energy was called included.
  std::string title;
  std::string note;                             // clauses, with "; " between them
  std::size_t note_lines = 1;                   // that there is room for at least
  bool goes_below = false, goes_above = false;  // values are beyond the ends
};

// The scale of a quantity, the density of this energy, with the range that was asked for. Throws
// Error(Usage) as ColorScale does, naming --color-range, and for a density whose energy the claims
// do not name.
ColorScale picture_scale(const ClaimedEnergy& energy, Quantity quantity,
                         const std::optional<ColorRange>& range);

// Values that are shown as colours.
struct ValueSummary {
  std::int64_t count = 0, below = 0, above = 0;  // of the scale

  void add(const ColorScale& scale, double value);
  void add(const ValueSummary& other);
};

// "; smallest 4, largest 12.5 (45 points a face)": of the whole map at extreme_samples() of its
// faces, as in reports, whatever is drawn; turned over and flat faces left out. Empty where none is
// left.
std::string extremes_clause(const MapFile& map, Quantity quantity, const ClaimedEnergy& energy);
// "; 2 of 100 triangle means below 4.5; 1 of ..." where values are beyond the ends of the scale.
// parts: what the colours are of, "triangle means".
std::string beyond_clauses(const ColorScale& scale, const ValueSummary& values,
                           const std::string& parts);

// The scale alone: what is shown, and the isometry.
Legend scale_legend(Quantity quantity, const ColorScale& scale, const ClaimedEnergy& energy);
// Of one map, with its degree and its extremes.
Legend make_legend(const MapFile& map, Quantity quantity, const ColorScale& scale);
// The same, saying how many values are beyond its ends.
Legend with_values(const Legend& legend, const ValueSummary& values, const std::string& parts);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
