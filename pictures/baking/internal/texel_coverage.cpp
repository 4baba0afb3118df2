#include "majorant/pictures/baking/internal/texel_coverage.h"

#include <algorithm>

namespace majorant {
namespace {

// Returns the box of the points at which a bilinear filter reads this texel, twice its size.
Box2 filtered_box(const TexelGrid& grid, int x, int y) {
  return {grid.point(x - 0.5, y + 1.5), grid.point(x + 1.5, y - 0.5)};
}

void find_centers(const InverseMap& layout, const TexelGrid& grid, TexelBand& band,
                  BakeCounts& counts, const StopCheck& stop) {
  const int last = std::min(band.bottom(), grid.height() - 1);
  for (int y = std::max(band.top() - 1, 0); y <= last; ++y) {
    stop.poll();
    for (int x = 0; x < grid.width(); ++x) {
      const std::vector<Preimage> found = layout.preimages(grid.center(x, y));
      if (found.empty()) continue;
      CoveredTexel& texel = band.at(x, y);
      texel.place = shown(found);
      texel.texel = Texel::Centre;
      if (y < band.top() || y >= band.bottom()) continue;  // another band counts it
      const auto proven =
          std::count_if(found.begin(), found.end(), [](const Preimage& p) { return p.proven; });
      ++counts.covered;
      counts.doubly_covered += proven > 1 ? 1 : 0;
      counts.undecided += proven == 0 ? 1 : 0;
    }
  }
}

void cover_part(const LayoutPieces& pieces, const LayoutPiece& piece, const Box2& box,
                CoveredTexel& texel) {
  const ClippedTriangle part = clipped(piece.uv, box);
  if (texel.texel == Texel::Part && !(part.area > texel.area)) return;
  texel = {pieces.place(piece, part.centroid), part.area, 0, &piece, Texel::Part};
}

void cover_margin(const LayoutPieces& pieces, const LayoutPiece& piece, const Vector2& center,
                  CoveredTexel& texel) {
  const auto lifted = [](const Vector2& p) { return Vector3(p.x(), p.y(), 0); };
  const NearestPoint nearest = nearest_of_triangle(lifted(piece.uv[0]), lifted(piece.uv[1]),
                                                   lifted(piece.uv[2]), lifted(center));
  if (texel.texel == Texel::Margin && !(nearest.distance < texel.distance)) return;
  texel = {pieces.place(piece, nearest.barycentric), 0, nearest.distance, &piece, Texel::Margin};
}

// Finds texels of the band without a centre in a chart that this piece covers in part, or that are
// filtered together with texels that have one.
void cover(const LayoutPieces& pieces, const TexelGrid& grid, const LayoutPiece& piece,
           bool has_margin, TexelBand& band) {
  const auto [left, right] = std::minmax({piece.uv[0].x(), piece.uv[1].x(), piece.uv[2].x()});
  const auto [low, high] = std::minmax({piece.uv[0].y(), piece.uv[1].y(), piece.uv[2].y()});
  const int first = std::max(grid.column(left) - kPieceReach, 0);
  const int last = std::min(grid.column(right) + kPieceReach, grid.width() - 1);
  const int above = std::max(grid.row(high) - kPieceReach, band.top());
  const int below = std::min(grid.row(low) + kPieceReach, band.bottom() - 1);
  for (int y = above; y <= below; ++y)
    for (int x = first; x <= last; ++x) {
      CoveredTexel& texel = band.at(x, y);
      if (texel.texel == Texel::Centre) continue;
      if (interiors_meet(piece.uv, grid.box(x, y)))
        cover_part(pieces, piece, grid.box(x, y), texel);
      else if (texel.texel != Texel::Part && has_margin &&
               interiors_meet(piece.uv, filtered_box(grid, x, y)))
        cover_margin(pieces, piece, grid.center(x, y), texel);
    }
}

}  // namespace

SurfacePlace shown(const std::vector<Preimage>& found) {
  const auto proven =
      std::find_if(found.begin(), found.end(), [](const Preimage& p) { return p.proven; });
  const Preimage& one = proven == found.end() ? found.front() : *proven;
  return {one.face, one.barycentric};
}

TexelBand covered_band(const InverseMap& layout, const TexelGrid& grid, const LayoutPieces& pieces,
                       int band, bool has_margin, BakeCounts& counts, const StopCheck& stop) {
  const int top = band * kBandRows;
  TexelBand texels(top, std::min(top + kBandRows, grid.height()), grid.width());
  find_centers(layout, grid, texels, counts, stop);
  pieces.for_band(
      band, [&](const LayoutPiece& piece) { cover(pieces, grid, piece, has_margin, texels); });
  return texels;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
