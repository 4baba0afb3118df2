#include "apps/compare/matched_maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/maps/bezier_cell.h"

namespace majorant {
namespace {

using Place = std::array<double, 3>;
using Corners = std::array<Place, 3>;

Place place_of(const MapFile& map, Index cell, Index corner) {
  const Vector3 p = map.points.row(map.cells(cell, corner));
  return {p.x() + 0.0, p.y() + 0.0, p.z() + 0.0};  // turns -0 into 0
}

// The corners of a cell, from the corner with the smallest position on, and the number of that
// corner.
struct TurnedCell {
  Corners corners;
  int first;
};

TurnedCell turned(const MapFile& map, Index cell) {
  const Corners all{place_of(map, cell, 0), place_of(map, cell, 1), place_of(map, cell, 2)};
  const auto first = static_cast<int>(std::min_element(all.begin(), all.end()) - all.begin());
  TurnedCell result{all, first};
  std::rotate(result.corners.begin(), result.corners.begin() + first, result.corners.end());
  return result;
}

// Returns local control points after a rotation of a cell: new corner k is old corner (k + shift)
// mod 3.
std::vector<Index> turned_locals(int degree, int shift) {
  const auto indices = bezier_multi_indices(degree);
  std::vector<Index> locals;
  for (const auto& index : indices) {
    std::array<int, 3> before{};
    for (std::size_t k = 0; k < 3; ++k)
      before[(k + static_cast<std::size_t>(shift)) % 3] = index[k];
    const auto found = std::find_if(indices.begin(), indices.end(), [&](const auto& other) {
      return other[0] == before[0] && other[1] == before[1] && other[2] == before[2];
    });
    locals.push_back(static_cast<Index>(found - indices.begin()));
  }
  return locals;
}

// Reorders the optional array of cells.
template <class Array>
Array reordered(const Array& rows, const std::vector<Index>& order) {
  if (rows.rows() == 0) return rows;
  return rows(order, Eigen::all);
}

}  // namespace

MapFile matched_to(const MapFile& model, const std::string& model_name, const MapFile& map,
                   const std::string& name) {
  const auto differ = [&](const std::string& reason) {
    return Error(
        ErrorKind::Unsupported,
        fmt::format("{} and {} are maps of different surfaces: {}; give two results of one",
                    model_name, name, reason));
  };
  if (model.cells.rows() != map.cells.rows())
    throw differ(fmt::format("{} and {} triangles", model.cells.rows(), map.cells.rows()));
  std::multimap<Corners, std::pair<Index, int>> cell_at;  // corners -> cell and its first corner
  for (Index c = 0; c < map.cells.rows(); ++c) {
    const TurnedCell t = turned(map, c);
    cell_at.emplace(t.corners, std::pair{c, t.first});
  }
  std::vector<Index> order;
  std::vector<int> shifts;
  for (Index c = 0; c < model.cells.rows(); ++c) {
    const TurnedCell t = turned(model, c);
    const auto found = cell_at.find(t.corners);
    if (found == cell_at.end())
      throw differ(fmt::format("triangle {} of the first is none of the second", c));
    order.push_back(found->second.first);
    shifts.push_back((found->second.second - t.first + 3) % 3);
    cell_at.erase(found);
  }
  MapFile matched = map;
  matched.input_face = reordered(map.input_face, order);
  matched.distortion = reordered(map.distortion, order);
  matched.min_det = reordered(map.min_det, order);
  matched.chart = reordered(map.chart, order);
  matched.seam_edges = reordered(map.seam_edges, order);
  matched.face_distortion = reordered(map.face_distortion, order);
  const std::array locals{turned_locals(map.degree, 0), turned_locals(map.degree, 1),
                          turned_locals(map.degree, 2)};
  for (Index c = 0; c < map.cells.rows(); ++c) {
    const int shift = shifts[to_size(c)];
    for (Index l = 0; l < map.cells.cols(); ++l)
      matched.cells(c, l) = map.cells(order[to_size(c)], locals[to_size(shift)][to_size(l)]);
    if (matched.seam_edges.rows() > 0)
      for (int k = 0; k < 3; ++k)  // edge k starts at corner k
        matched.seam_edges(c, k) = map.seam_edges(order[to_size(c)], (k + shift) % 3);
  }
  return matched;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
