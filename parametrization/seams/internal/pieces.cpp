#include "majorant/parametrization/seams/internal/pieces.h"

#include <algorithm>

#include "majorant/mesh/cut_chains.h"

namespace majorant {

std::vector<std::vector<Index>> component_faces(const std::vector<Index>& opposites) {
  const std::vector<Index> component = face_components(opposites);
  std::vector<std::vector<Index>> faces;
  for (std::size_t f = 0; f < component.size(); ++f) {
    if (to_size(component[f]) >= faces.size()) faces.resize(to_size(component[f]) + 1);
    faces[component[f]].push_back(static_cast<Index>(f));
  }
  return faces;
}

Index genus(const SurfaceMesh& mesh) {
  const Topology& t = mesh.topology();
  return (2 - t.boundary_loops - t.euler_characteristic()) / 2;
}

bool is_planar(const SurfaceMesh& mesh) {
  return mesh.topology().boundary_loops > 0 && genus(mesh) == 0;
}

void open_pieces(const SurfaceMesh& mesh, const Vec& edge_cost, std::vector<char>& is_cut,
                 const StopCheck& stop) {
  for (const auto& [part, faces, vertices] : mesh.cut_along(is_cut, nullptr).split(stop)) {
    stop.poll();
    const SurfaceMesh& piece = *part;
    if (is_planar(piece)) continue;
    Vec cost(piece.half_edge_count());
    for (Index h = 0; h < cost.size(); ++h)
      cost[h] = edge_cost[3 * faces[face_of(h)] + corner_of(h)];
    const std::vector<char> more = planar_cut(piece, cost, stop);
    for (Index h = 0; h < cost.size(); ++h)
      if (more[h]) is_cut[3 * faces[face_of(h)] + corner_of(h)] = 1;
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
