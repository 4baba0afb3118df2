#include "majorant/mesh/internal/collapsed_edges.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <span>

#include "majorant/mesh/union_find.h"

namespace majorant {
namespace {

// Returns the diagonal of the bounding box of the vertices that faces use.
double diagonal_of(const PolygonMesh& input) {
  Eigen::AlignedBox3d box;
  for (const Index v : input.polygons.indices()) box.extend(input.positions[v]);
  return box.isEmpty() ? 0 : box.diagonal().norm();
}

// Adds the rest of a polygon of the input, if it still has three corners.
void add_polygon(std::span<const Index> polygon, Index number, CollapsedEdges& result) {
  std::vector<Index> left, corners;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Index v = result.vertex[polygon[k]];
    if (!left.empty() && left.back() == v) continue;
    left.push_back(v);
    corners.push_back(static_cast<Index>(k));
  }
  while (left.size() > 1 && left.front() == left.back()) {
    left.pop_back();
    corners.pop_back();
  }
  if (left.size() < 3) return;
  result.mesh.polygons.push_back(left);
  result.corners.push_back(corners);
  result.polygon.push_back(number);
}

}  // namespace

CollapsedEdges collapse_short_edges(const PolygonMesh& input, const StopCheck& stop) {
  CollapsedEdges result;
  const auto vertices = static_cast<Index>(input.positions.size());
  const double close = kTenDigits * diagonal_of(input);
  UnionFind places(vertices);
  for (std::size_t p = 0; p < input.polygons.size(); ++p) {
    stop.poll_at(p);
    const std::span<const Index> polygon = input.polygons[p];
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const auto [a, b] = std::minmax(polygon[k], polygon[(k + 1) % polygon.size()]);
      if (a == b || !((input.positions[a] - input.positions[b]).norm() <= close)) continue;
      result.edges.push_back({a, b});
      places.join(a, b);
    }
  }
  if (result.edges.empty()) return result;
  std::sort(result.edges.begin(), result.edges.end());
  result.edges.erase(std::unique(result.edges.begin(), result.edges.end()), result.edges.end());
  for (Index v = 0; v < vertices; ++v) result.vertex.push_back(places.find(v));
  result.mesh.file = input.file;
  result.mesh.positions = input.positions;
  result.mesh.position_rounding = input.position_rounding;
  for (std::size_t p = 0; p < input.polygons.size(); ++p)
    add_polygon(input.polygons[p], static_cast<Index>(p), result);
  return result;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
