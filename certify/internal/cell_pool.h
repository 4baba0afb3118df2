// The cells of a file by the places of their corners, with flags of those already matched to faces
// of a surface.
//
//   const ShownCells cells{*mesh};
//   std::vector<Index> place_of(to_size(mesh->vertex_count()), NamedVertices::kNew);
//   place_of[12] = 7;
//   CellPool pool(cells, place_of, polygons.positions.size());
//   for (const Index cell : pool.at(7))
//     if (pool.may_be_of(cell, 3)) pool.take({cell});
#pragma once

#include <array>
#include <functional>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "majorant/certify/internal/surface_match.h"

namespace majorant {

using CellCorners = std::array<Index, 3>;  // for a cell or face: places, or corners of its polygon

// Cells connected across edges that are not on the border of the part that they should cover.
struct CellRegion {
  std::function<bool(Index cell)> has;
  std::function<bool(Index v, Index w)> is_border;  // vertices of the cells
  std::function<bool(const std::vector<Index>& cells)> is_covered;
};

class CellPool {
 public:
  // place_of: by vertex of the cells, a place below place_count, or NamedVertices::kNew. cells must
  // outlive this.
  CellPool(const ShownCells& cells, std::vector<Index> place_of, std::size_t place_count);

  const SurfaceMesh& mesh() const { return cells_.mesh; }
  Index place_of(Index vertex) const { return place_of_[vertex]; }
  CellCorners places(Index cell) const;
  // Returns the cells with a corner at a place.
  const std::vector<Index>& at(Index place) const { return cells_at_[place]; }
  const Vector3 position(Index cell, Index corner) const {
    return mesh().input_position(mesh().faces()(cell, corner));
  }
  Vector3 area_of(Index cell) const;  // returns area_vector()

  bool is_taken(Index cell) const { return is_taken_[cell] != 0; }
  bool may_be_of(Index cell, Index face) const {
    return !is_taken_[cell] && (cells_.face.empty() || cells_.face[cell] == face);
  }
  void take(const std::vector<Index>& cells) {
    for (const Index c : cells) is_taken_[c] = 1;
  }
  // Takes the first region that contains a cell at this place and covers its part. Returns whether
  // there is one.
  bool take_region(const CellRegion& region, Index place);

 private:
  std::vector<Index> region_of(const CellRegion& region, Index seed) const;
  Index across(const CellRegion& region, Index h, const std::set<Index>& known) const;

  const ShownCells& cells_;
  std::vector<Index> place_of_;
  std::vector<std::vector<Index>> cells_at_;                             // by place
  std::map<std::pair<Index, Index>, std::vector<Index>> cells_left_of_;  // by vertices of the file
  std::vector<char> is_taken_;                                           // by cell
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
