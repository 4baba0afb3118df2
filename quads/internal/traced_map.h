// The first three stages of a quad mesh: a surface with resolved features and its seamless map; the
// map on a lattice of integers; the T-mesh that is traced on it.
//
//   QuadSeconds seconds;
//   const auto traced = traced_map(*mesh, {}, {}, record, seconds);
//   std::cout << traced->t_mesh.patches.size() << " rectangles\n";
#pragma once

#include <memory>
#include <vector>

#include "majorant/framework/run_record.h"
#include "majorant/quads/internal/aligned_map.h"
#include "majorant/quads/internal/resolved_surface.h"
#include "majorant/quads/internal/seamless_lattice.h"
#include "majorant/quads/internal/t_mesh.h"
#include "majorant/quads/quad_mesh.h"

namespace majorant {

struct TracedMap {
  ResolvedSurface resolved;
  AlignedMap aligned;
  SeamlessLattice lattice;
  TMesh t_mesh;

  TracedMap(ResolvedSurface surface, const SeamlessOptions& map_options, RunRecord& record,
            QuadSeconds& seconds);
  TracedMap(const TracedMap&) = delete;  // the lattice refers to the surface
  TracedMap& operator=(const TracedMap&) = delete;
};

// features: 3 #F of the mesh, or empty. If a coarse surface has no map, because its faces are too
// large for the cones of a field, it is subdivided. Throws Error(Infeasible) if there is no map
// then either.
std::unique_ptr<const TracedMap> traced_map(const SurfaceMesh& mesh,
                                            const std::vector<char>& features,
                                            const QuadMeshOptions& options, RunRecord& record,
                                            QuadSeconds& seconds);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
