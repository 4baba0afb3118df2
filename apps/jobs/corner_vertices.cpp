#include "majorant/apps/jobs/corner_vertices.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

namespace majorant {
namespace {

// Returns the vertices of the polygon at the corners of the cell: by number, else by place, each
// once. A corner that the polygon lacks keeps its number.
std::array<Index, 3> vertices_of_cell(const MapFile& map, Index cell, const PolygonMesh& input) {
  const auto& polygon = input.polygons[map.input_face[cell]];
  std::array<Index, 3> vertices;
  std::vector<char> is_taken(polygon.size(), 0);
  const auto take = [&](std::size_t k, const auto& is_it) {
    for (std::size_t i = 0; i < polygon.size(); ++i)
      if (!is_taken[i] && is_it(polygon[i])) {
        is_taken[i] = 1;
        vertices[k] = polygon[i];
        return true;
      }
    return false;
  };
  std::array<bool, 3> is_found{};
  for (std::size_t k = 0; k < 3; ++k) {
    vertices[k] = map.input_vertex[map.cells(cell, static_cast<Index>(k))];
    is_found[k] = take(k, [&, name = vertices[k]](Index v) { return v == name; });
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (is_found[k]) continue;
    const Vector3 place = map.points.row(map.cells(cell, static_cast<Index>(k)));
    take(k, [&](Index v) { return input.positions[v] == place; });
  }
  return vertices;
}

template <class Array>
void append_copies(Array& array, const std::vector<Index>& copied) {
  if (array.rows() == 0) return;
  const Eigen::Index rows = array.rows();
  array.conservativeResize(rows + static_cast<Eigen::Index>(copied.size()), array.cols());
  for (std::size_t k = 0; k < copied.size(); ++k)
    array.row(rows + static_cast<Eigen::Index>(k)) = array.row(copied[k]);
}

}  // namespace

std::optional<MapFile> with_corner_vertices(const MapFile& map, const PolygonMesh& input) {
  if (map.input_vertex.size() == 0 || map.input_face.size() == 0) return std::nullopt;
  const auto polygons = static_cast<Index>(input.polygons.size());
  std::map<std::pair<Index, Index>, Index> copies;  // by point and vertex
  std::vector<Index> copied;                        // original points
  std::vector<Index> names;                         // vertices of the copies
  Cells cells = map.cells;
  const auto points = static_cast<Index>(map.points.rows());
  for (Index c = 0; c < cells.rows(); ++c) {
    if (map.input_face[c] < 0 || map.input_face[c] >= polygons) continue;
    const std::array<Index, 3> vertices = vertices_of_cell(map, c, input);
    for (Index k = 0; k < 3; ++k) {
      const Index point = cells(c, k), vertex = vertices[to_size(k)];
      if (vertex == map.input_vertex[point]) continue;
      const auto [copy, is_new] =
          copies.try_emplace({point, vertex}, points + static_cast<Index>(copied.size()));
      if (is_new) copied.push_back(point), names.push_back(vertex);
      cells(c, k) = copy->second;
    }
  }
  if (copied.empty()) return std::nullopt;
  MapFile named = map;
  named.cells = std::move(cells);
  append_copies(named.points, copied);
  append_copies(named.uv, copied);
  append_copies(named.uv_rounding, copied);
  append_copies(named.input_vertex, copied);
  append_copies(named.cone, copied);
  named.input_vertex.tail(static_cast<Eigen::Index>(names.size())) =
      Eigen::Map<const Eigen::VectorXi>(names.data(), static_cast<Eigen::Index>(names.size()));
  return named;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
