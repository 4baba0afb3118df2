// Which point of a layout each texel of a band of rows shows.
//
// A texel shows its centre, where that lies in a chart. Else it shows the middle of what is covered
// of it, of the piece that covers most (Part); else, where a filter reads it together with covered
// texels, the nearest piece (Margin).
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "majorant/certify/inverse_map.h"
#include "majorant/pictures/baking/bake.h"
#include "majorant/pictures/baking/internal/layout_pieces.h"
#include "majorant/pictures/baking/seam_levelling.h"

namespace majorant {

// The box of the points that a bilinear filter mixes with this texel: of twice its size.
// What is found of a texel before it has a value.
struct CoveredTexel {
  SurfacePlace place;
  double area = 0;                      // of Part: of the piece that covers most
  double distance = 0;                  // of Margin: of the nearest piece, squared
  const LayoutPiece* beside = nullptr;  // that piece
  Texel texel = Texel::Empty;
};

// The texels of some rows, and one row more above and below, of which the centres alone are known.
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
  // Returns whether one of the texels around shows its centre in this chart.
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

// Returns the preimage that a texel shows: the first that is proven, where there is one.
SurfacePlace shown(const std::vector<Preimage>& found);

// Finds what the texels of a band show, and counts those with centres. has_margin: texels of Margin
// are found, too.
TexelBand covered_band(const InverseMap& layout, const TexelGrid& grid, const LayoutPieces& pieces,
                       int band, bool has_margin, BakeCounts& counts, const StopCheck& stop);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
