#include "majorant/pictures/baking/internal/layout_pieces.h"

#include <algorithm>
#include <numeric>

namespace majorant {

LayoutPieces::LayoutPieces(const BezierMap& map, const TexelGrid& grid) {
  divide(map.degree() == 1 ? 1 : kCurvePieces);
  const Points2 uv = map.sample(points_);
  const auto per_face = static_cast<Index>(points_.size());
  for (Index f = 0; f < map.mesh().face_count(); ++f)
    for (std::size_t part = 0; part < parts_.size(); ++part) {
      LayoutPiece piece{{}, f, static_cast<int>(part)};
      for (std::size_t k = 0; k < 3; ++k) piece.uv[k] = uv.row(per_face * f + parts_[part][k]);
      pieces_.push_back(piece);
    }
  sort_into_bands(grid);
}

SurfacePlace LayoutPieces::place(const LayoutPiece& piece, const Barycentric& xi) const {
  SurfacePlace place{piece.face, Barycentric::Zero()};
  for (Index k = 0; k < 3; ++k)
    place.barycentric += xi[k] * points_[to_size(parts_[to_size(piece.part)][to_size(k)])];
  return place;
}

void LayoutPieces::divide(int n) {
  std::vector<std::vector<Index>> number(to_size(n) + 1);
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n - i; ++j) {
      number[to_size(i)].push_back(static_cast<Index>(points_.size()));
      points_.emplace_back(static_cast<double>(i) / n, static_cast<double>(j) / n,
                           static_cast<double>(n - i - j) / n);
    }
  const auto at = [&](int i, int j) { return number[to_size(i)][to_size(j)]; };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n - i; ++j) {
      parts_.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      if (j + 1 < n - i) parts_.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
}

void LayoutPieces::sort_into_bands(const TexelGrid& grid) {
  const int bands = band_count(grid.height());
  const auto for_bands_of = [&](const LayoutPiece& piece, const auto& visit) {
    const auto [least, most] = std::minmax({piece.uv[0].y(), piece.uv[1].y(), piece.uv[2].y()});
    const int top = std::max(grid.row(most) - kPieceReach, 0);
    const int bottom = std::min(grid.row(least) + kPieceReach, grid.height() - 1);
    for (int b = top / kBandRows; b <= bottom / kBandRows; ++b) visit(to_size(b));
  };
  first_.assign(to_size(bands) + 1, 0);
  for (const LayoutPiece& piece : pieces_)
    for_bands_of(piece, [&](std::size_t b) { ++first_[b + 1]; });
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  in_band_.resize(first_.back());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < pieces_.size(); ++i)
    for_bands_of(pieces_[i], [&](std::size_t b) { in_band_[next[b]++] = i; });
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
