// Finds the point of a layout that each texel of a band of rows shows.
//
// A texel shows its centre if that lies in a chart. Else it shows the middle of its covered part,
// on the piece that covers most (Part). Else, if a filter reads it together with covered texels, it
// shows the nearest piece (Margin).
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "majorant/certify/inverse_map.h"
#include "majorant/pictures/baking/bake.h"
#include "majorant/pictures/baking/internal/layout_pieces.h"
#include "majorant/pictures/baking/seam_levelling.h"

namespace majorant {

// The coverage of a texel, before it has a value.
struct CoveredTexel {
  SurfacePlace place;
  double area = 0;                      // for Part: of the piece that covers most
  double distance = 0;                  // for Margin: squared distance of the nearest piece
  const LayoutPiece* beside = nullptr;  // that piece
  Texel texel = Texel::Empty;
};

// The texels of some rows, and of one row above and below, for which only centres are known.
class TexelBand {
 public:
  TexelBand(int top, int bottom, int width)
      : top_(top),
        bottom_(bottom),
        width_(width),
        texels_(to_size(bottom - top + 2) * to_size(width)) {}

  CoveredTexel& at(int x, int y) {
    return texels_[to_size(y - top_ + 1) * to_size(width_) + to_size(x)];
  }
  // Returns whether a neighbouring texel shows its centre in this chart.
  template <class ChartOf>
  bool has_center_beside(int x, int y, Index chart, const ChartOf& chart_of) {
    for (int row = y - 1; row <= y + 1; ++row)
      for (int column = std::max(x - 1, 0); column <= std::min(x + 1, width_ - 1); ++column)
        if (const CoveredTexel& texel = at(column, row);
            texel.texel == Texel::Centre && chart_of(texel.place.face) == chart)
          return true;
    return false;
  }
  int top() const { return top_; }
  int bottom() const { return bottom_; }

 private:
  int top_, bottom_, width_;
  std::vector<CoveredTexel> texels_;
};

// Returns the preimage that a texel shows: the first proven one, if any.
SurfacePlace shown(const std::vector<Preimage>& found);

// Finds what the texels of a band show, and counts those with centres. has_margin: also find texels
// of Margin.
TexelBand covered_band(const InverseMap& layout, const TexelGrid& grid, const LayoutPieces& pieces,
                       int band, bool has_margin, BakeCounts& counts, const StopCheck& stop);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
