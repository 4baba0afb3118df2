// The seamless map from which quads are made, of degree 1, with the border and features along its
// axes. It minimizes the symmetric Dirichlet energy,
//     min int_M |J|^2 + |J^-1|^2,   det J > 0,
//     u^+ = i^k u^- + t across every seam,   one coordinate constant along every held edge.
//
//   const ResolvedSurface resolved = resolve_feature_edges(*mesh, sharp_edges(*mesh, 35));
//   const AlignedMap aligned = aligned_map(resolved, {}, record);
//   SeamlessLattice lattice(resolved.mesh, aligned.map, resolved.is_feature);
#pragma once

#include "majorant/framework/run_record.h"
#include "majorant/maps/bezier_map.h"
#include "majorant/parametrization/initialization/start.h"
#include "majorant/quads/internal/resolved_surface.h"

namespace majorant {

struct AlignedMap {
  BezierMap map;
  Status status;  // of the optimization, which a limit may have ended
};

// Makes the map. Its aligned edges are those of the surface, if there are any. Throws
// Error(Infeasible) for cones of one quarter turn, and if the field cannot follow the border and
// features; else the errors of make_seamless().
AlignedMap aligned_map(const ResolvedSurface& surface, SeamlessOptions settings, RunRecord& record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
