#include "majorant/mesh/half_edge_flip.h"

namespace majorant {

FlippedSides flipped_sides(Index half_edge, Index opposite) {
  return {{next(half_edge), previous(half_edge), next(opposite), previous(opposite)},
          {previous(opposite), next(half_edge), previous(half_edge), next(opposite)}};
}

FlippedSides flip_half_edge(Cells& faces, std::vector<Index>& opposite, Index half_edge) {
  const Index h = half_edge, o = opposite[h];
  const FlippedSides moved = flipped_sides(h, o);
  std::array<Index, 4> outside{};
  for (std::size_t k = 0; k < 4; ++k) {
    outside[k] = opposite[moved.from[k]];
    for (std::size_t l = 0; l < 4; ++l)
      if (opposite[moved.from[k]] == moved.from[l]) outside[k] = moved.to[l];
  }
  for (std::size_t k = 0; k < 4; ++k) {
    opposite[moved.to[k]] = outside[k];
    if (outside[k] >= 0) opposite[outside[k]] = moved.to[k];
  }
  const auto origin = [&faces](Index side) { return from_vertex(faces, side); };
  const Index a = origin(h), b = origin(o), c = origin(previous(h)), d = origin(previous(o));
  const std::array<Index, 6> sides{h, next(h), previous(h), o, next(o), previous(o)},
      origins{d, c, a, c, d, b};
  for (std::size_t k = 0; k < 6; ++k) faces(face_of(sides[k]), corner_of(sides[k])) = origins[k];
  return moved;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
