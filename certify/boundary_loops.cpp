#include "majorant/certify/boundary_loops.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "majorant/elements/bernstein_space.h"

namespace majorant {
namespace {

PlanarCurve curve_of(const BezierMap& map, Index half_edge) {
  PlanarCurve curve;
  curve.degree = map.degree();
  std::size_t k = 0;
  for (const Index node : edge_nodes(map.space(), half_edge))
    curve.control_points[k++] = map.control_points().segment<2>(2 * node);
  return curve;
}

}  // namespace

void BoundaryLoops::add_loop(Index chart, const std::vector<PlanarCurve>& loop,
                             const std::vector<Index>& half_edges) {
  const auto first = static_cast<Index>(curves.size());
  curves.insert(curves.end(), loop.begin(), loop.end());
  half_edge.insert(half_edge.end(), half_edges.begin(), half_edges.end());
  loops.push_back({first, static_cast<Index>(curves.size()), chart});
}

std::string BoundaryLoops::defect() const {
  Index expected = 0;
  const auto count = static_cast<Index>(curves.size());
  for (const BoundaryLoop& loop : loops) {
    if (loop.first != expected || loop.last > count || loop.chart < 0 || loop.chart >= charts)
      return "the boundary is not a list of loops";
    expected = loop.last;
    if (loop.last - loop.first < 3) return "a boundary loop has fewer than three edges";
    for (Index k = loop.first; k < loop.last; ++k) {
      const PlanarCurve& curve = curves[k];
      if (curve.degree < 1 || curve.degree > PlanarCurve::kMaxDegree)
        return fmt::format("a boundary curve has degree {}", curve.degree);
      if (!curve.in_range()) return "control points are not finite, or too large";
      const PlanarCurve& after = curves[k + 1 < loop.last ? k + 1 : loop.first];
      if (curve.back() != after.front()) return "a boundary loop is not closed";
    }
  }
  return expected == count && half_edge.size() == curves.size()
             ? ""
             : "the boundary is not a list of loops";
}

std::vector<Index> BoundaryLoops::next() const {
  std::vector<Index> next(curves.size());
  std::iota(next.begin(), next.end(), 1);
  for (const BoundaryLoop& loop : loops) next[loop.last - 1] = loop.first;
  return next;
}

BoundaryLoops boundary_loops(const BezierMap& map) {
  const SurfaceMesh& mesh = map.mesh();
  BoundaryLoops boundary;
  const std::vector<Index> component = face_components(mesh.opposites());
  for (const Index c : component) boundary.charts = std::max(boundary.charts, c + 1);
  for (const std::vector<Index>& half_edges : boundary_half_edges(mesh.faces(), mesh.opposites())) {
    std::vector<PlanarCurve> curves;
    for (const Index h : half_edges) curves.push_back(curve_of(map, h));
    boundary.add_loop(component[face_of(half_edges.front())], curves, half_edges);
  }
  return boundary;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
