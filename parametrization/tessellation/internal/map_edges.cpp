#include "majorant/parametrization/tessellation/internal/map_edges.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "majorant/framework/pair_order.h"
#include "majorant/maps/bezier_cell.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/mesh/union_find.h"

namespace majorant {
namespace {

// Returns a number for each vertex of the coarse mesh, the same for vertices that are one in the
// map.
std::vector<Index> nodes_of_corners(const MapFile& map, const CornerMesh& coarse) {
  const auto vertices = static_cast<Index>(coarse.positions.size());
  const bool is_named = map.input_vertex.size() > 0;
  const Index named =
      is_named ? map.input_vertex(map.cells.leftCols<3>().reshaped()).maxCoeff() + 1 : 0;
  const auto points = static_cast<Index>(map.points.rows());
  UnionFind nodes(vertices + points + named);
  for (std::size_t c = 0; c < coarse.cell.size(); ++c)
    for (Index k = 0; k < 3; ++k) {
      const Index point = map.cells(coarse.cell[c], k);
      nodes.join(coarse.vertices(static_cast<Index>(c), k), vertices + point);
      if (is_named && map.input_vertex[point] >= 0)
        nodes.join(vertices + point, vertices + points + map.input_vertex[point]);
    }
  std::vector<Index> result;
  for (Index v = 0; v < vertices; ++v) result.push_back(nodes.find(v));
  return result;
}

// Compares the control points of two sides of an edge.
class SideComparison {
 public:
  // node: by vertex of the coarse mesh. All three must outlive this object.
  SideComparison(const MapFile& map, const CornerMesh& coarse, const std::vector<Index>& node)
      : map_(map),
        coarse_(coarse),
        node_(node),
        edge_points_{bezier_edge_points(map.degree, 0), bezier_edge_points(map.degree, 1),
                     bezier_edge_points(map.degree, 2)} {}

  bool are_same(const MapEdges::Side& side, const MapEdges::Side& other) const {
    const bool is_reversed = start(side) != start(other);
    const std::vector<int>&mine = edge_points_[side.edge], &theirs = edge_points_[other.edge];
    for (std::size_t i = 0; i < mine.size(); ++i)
      if (map_.cells(coarse_.cell[side.cell], mine[is_reversed ? mine.size() - 1 - i : i]) !=
          map_.cells(coarse_.cell[other.cell], theirs[i]))
        return false;
    return true;
  }

 private:
  Index start(const MapEdges::Side& side) const {
    return node_[coarse_.vertices(side.cell, side.edge)];
  }

  const MapFile& map_;
  const CornerMesh& coarse_;
  const std::vector<Index>& node_;
  std::array<std::vector<int>, 3> edge_points_;
};

}  // namespace

MapEdges::MapEdges(const MapFile& map, const CornerMesh& coarse)
    : node_(nodes_of_corners(map, coarse)), numbers_(coarse.cell.size()) {
  const auto vertices = static_cast<Index>(node_.size()),
             sides = 3 * static_cast<Index>(numbers_.size());
  const auto vertex = [&](Index h) { return coarse.vertices(face_of(h), corner_of(h)); };
  const NumberedPairs edges = numbered_in_order(vertices, sides, [&](Index h) {
    const Index from = node_[vertex(h)], to = node_[vertex(next(h))];
    return std::pair(std::min(from, to), std::max(from, to));
  });
  const NumberedPairs space_edges = numbered_in_order(vertices, sides, [&](Index h) {
    const Index from = vertex(h), to = vertex(next(h));
    return std::pair(std::min(from, to), std::max(from, to));
  });
  space_count_ = static_cast<Index>(space_edges.first.size());
  begin_.assign(edges.first.size() + 1, 0);
  for (const Index edge : edges.number) ++begin_[edge];
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  sides_.resize(to_size(sides));
  for (Index h = sides - 1; h >= 0; --h)
    sides_[--begin_[edges.number[h]]] = {face_of(h), corner_of(h)};
  const SideComparison comparison(map, coarse, node_);
  for (Index h = 0; h < sides; ++h) {
    const Side here{face_of(h), corner_of(h)};
    Index plane = -1;
    for (const Side& other : sides_of(edges.number[h])) {
      if (3 * other.cell + other.edge >= h) break;
      if (!comparison.are_same(here, other)) continue;
      plane = of(other.cell).plane[other.edge];
      break;
    }
    if (plane < 0) {
      plane = plane_count();
      plane_sides_.push_back(0);
    }
    ++plane_sides_[plane];
    Numbers& numbers = numbers_[here.cell];
    numbers.surface[here.edge] = edges.number[h];
    numbers.space[here.edge] = space_edges.number[h];
    numbers.plane[here.edge] = plane;
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
