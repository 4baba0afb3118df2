#include "apps/mpi/boundary_proof.h"

#include "apps/mpi/internal/collect.h"
#include "majorant/certify/boundary_loops.h"

namespace majorant {

BoundaryOrder::BoundaryOrder(const SurfaceMesh& mesh, const std::vector<int>& rank_of_face) {
  std::vector<Index> counts, place(to_size(mesh.half_edge_count()), -1);
  std::vector<Index> leaving(to_size(mesh.vertex_count()), -1);
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    if (mesh.opposite(h) >= 0) continue;
    const auto rank = static_cast<std::size_t>(rank_of_face[h / 3]);
    if (counts.size() <= rank) counts.resize(rank + 1);
    place[h] = counts[rank]++;
    leaving[mesh.from_vertex(h)] = h;
  }
  for (const std::vector<Index>& vertices : mesh.boundary_loops()) {
    std::vector<Place>& loop = loops_.emplace_back();
    for (const Index v : vertices) {
      const Index h = leaving[v];
      loop.push_back({rank_of_face[h / 3], place[h], h});
    }
  }
}

GlobalInjectivity prove_boundary(const MeshPart& part, const BezierMap& map,
                                 const BoundaryOrder& order) {
  std::vector<double> mine;
  for (const Index h : part.boundary_half_edges)
    for (const Index node : edge_nodes(map.space(), h))
      for (const Index c : {0, 1}) mine.push_back(map.control_points()[2 * node + c]);
  const auto curves_of = gathered(part.ranks(), std::move(mine));
  if (part.ranks().rank() > 0) return {};
  const auto size = static_cast<std::size_t>(2 * (map.degree() + 1));
  BoundaryLoops boundary{.charts = 1};
  for (const auto& loop : order.loops()) {
    std::vector<PlanarCurve> curves;
    std::vector<Index> half_edges;
    for (const BoundaryOrder::Place& p : loop) {
      const double* points =
          curves_of[static_cast<std::size_t>(p.rank)].data() + to_size(p.place) * size;
      PlanarCurve curve;
      curve.degree = map.degree();
      for (std::size_t k = 0; 2 * k < size; ++k)
        curve.control_points[k] = {points[2 * k], points[2 * k + 1]};
      curves.push_back(curve);
      half_edges.push_back(p.half_edge);
    }
    boundary.add_loop(0, curves, half_edges);
  }
  return check_layout(boundary, {});
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
