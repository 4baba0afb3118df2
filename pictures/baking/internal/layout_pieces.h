// The faces of a layout as straight pieces, sorted into bands of texel rows.
//
// A curved face is divided along its edges into 8 chords, which leave a 64th of the sagitta. A
// piece belongs to the bands that it reaches, with a margin for filters.
#pragma once

#include <array>
#include <vector>

#include "majorant/certify/inverse_map.h"
#include "majorant/pictures/baking/chart_continuation.h"
#include "majorant/pictures/baking/texel_grid.h"

namespace majorant {

// Rows of texels in a band.
inline constexpr int kBandRows = 16;
// Rows and columns around a piece whose texels may depend on it: one for filters, one because row()
// and column() round.
inline constexpr int kPieceReach = 2;
// Straight pieces along the edge of a curved face.
inline constexpr int kCurvePieces = 8;

inline int band_count(int rows) { return (rows + kBandRows - 1) / kBandRows; }

// A straight piece of a face in the plane.
struct LayoutPiece {
  std::array<Vector2, 3> uv;
  Index face;
  int part;  // of the face
};

class LayoutPieces {
 public:
  LayoutPieces(const BezierMap& map, const TexelGrid& grid);

  template <class Visit>
  void for_band(int band, const Visit& visit) const {
    for (std::size_t i = first_[to_size(band)]; i < first_[to_size(band) + 1]; ++i)
      visit(pieces_[in_band_[i]]);
  }

  // Returns the point of the face at these barycentric coordinates in the piece.
  SurfacePlace place(const LayoutPiece& piece, const Barycentric& xi) const;

 private:
  void divide(int n);
  void sort_into_bands(const TexelGrid& grid);

  std::vector<Barycentric> points_;           // of a face
  std::vector<std::array<Index, 3>> parts_;   // parts of a face, by points
  std::vector<LayoutPiece> pieces_;           // face by face
  std::vector<std::size_t> first_, in_band_;  // by band
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
