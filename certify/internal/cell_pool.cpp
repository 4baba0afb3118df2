#include "majorant/certify/internal/cell_pool.h"

#include <algorithm>

namespace majorant {

CellPool::CellPool(const ShownCells& cells, std::vector<Index> place_of, std::size_t place_count)
    : cells_(cells),
      place_of_(std::move(place_of)),
      cells_at_(place_count),
      is_taken_(to_size(cells.mesh.face_count()), 0) {
  for (Index c = 0; c < mesh().face_count(); ++c)
    for (Index k = 0; k < 3; ++k) {
      const Index v = mesh().faces()(c, k), w = mesh().faces()(c, next(k));
      if (place_of_[v] != NamedVertices::kNew) cells_at_[place_of_[v]].push_back(c);
      cells_left_of_[{mesh().input_vertex(v), mesh().input_vertex(w)}].push_back(c);
    }
}

CellCorners CellPool::places(Index cell) const {
  CellCorners out;
  for (Index k = 0; k < 3; ++k) out[k] = place_of_[mesh().faces()(cell, k)];
  return out;
}

Vector3 CellPool::area_of(Index cell) const {
  return area_vector(std::array{position(cell, 0), position(cell, 1), position(cell, 2)});
}

bool CellPool::take_region(const CellRegion& region, Index place) {
  for (const Index seed : cells_at_[place]) {
    const std::vector<Index> cells = region_of(region, seed);
    if (cells.empty() || !region.is_covered(cells)) continue;
    take(cells);
    return true;
  }
  return false;
}

// Collects cells across all edges that are not on the border; empty if such an edge has no other
// side.
std::vector<Index> CellPool::region_of(const CellRegion& region, Index seed) const {
  if (!region.has(seed)) return {};
  std::vector<Index> cells{seed};
  std::set<Index> known{seed};
  for (std::size_t k = 0; k < cells.size(); ++k)
    for (Index corner = 0; corner < 3; ++corner) {
      const Index v = mesh().faces()(cells[k], corner), w = mesh().faces()(cells[k], next(corner));
      if (region.is_border(v, w)) continue;
      const Index beyond = across(region, 3 * cells[k] + corner, known);
      if (beyond < 0) return {};
      if (known.insert(beyond).second) cells.push_back(beyond);
    }
  return cells;
}

// Returns the cell across a half-edge; -1 if the region has none. The edge may be inside a face and
// open, because the same pieces are listed twice.
Index CellPool::across(const CellRegion& region, Index h, const std::set<Index>& known) const {
  if (const Index o = mesh().opposite(h); o >= 0) {
    const bool is_in = known.contains(face_of(o)) || region.has(face_of(o));
    return is_in ? face_of(o) : -1;
  }
  const auto found = cells_left_of_.find(
      {mesh().input_vertex(mesh().to_vertex(h)), mesh().input_vertex(mesh().from_vertex(h))});
  if (found == cells_left_of_.end()) return -1;
  const auto it = std::find_if(found->second.begin(), found->second.end(),
                               [&](Index c) { return known.contains(c) || region.has(c); });
  return it == found->second.end() ? -1 : *it;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
