#include "majorant/constraints/cut_surface.h"

#include <utility>

#include "majorant/constraints/constraints.h"
#include "majorant/framework/elimination.h"

namespace majorant {

CutSurface cut_open(const SurfaceMesh& mesh, const std::vector<char>& is_cut,
                    const std::vector<int>& turns, std::vector<int> quarter_turns) {
  CutSurface out;
  std::vector<Index> surface_vertex;
  out.mesh = std::make_shared<const SurfaceMesh>(mesh.cut_along(is_cut, &surface_vertex));
  std::vector<SeamEdge> edges;
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (is_cut[h] && mesh.opposite(h) > h) edges.push_back({h, mesh.opposite(h), turns[h]});
  out.seams = std::make_shared<const Seams>(out.mesh->faces(), std::move(surface_vertex),
                                            std::move(edges), std::move(quarter_turns));
  return out;
}

Vec project_to_seams(const CutSurface& surface, VecIn uv, double* moved) {
  const auto space = std::make_shared<const BezierTriangleSpace>(surface.mesh->faces(),
                                                                 surface.mesh->vertex_count(), 1);
  ConstraintRows rows;
  SeamlessConstraint(space, surface.seams).append_rows(rows);
  const Elimination elimination(2 * space->node_count(), rows);
  Vec out;
  elimination.expand(elimination.reduce(uv, moved), out);
  return out;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
