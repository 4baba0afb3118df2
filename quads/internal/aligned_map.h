// The seamless map that quads are made from: of degree 1, optimized, with the border and features
// along its axes.
//
//   const RoomySurface room = with_room(*mesh, sharp_edges(*mesh, 35));
//   const AlignedMap aligned = aligned_map(room, {}, record);
//   SeamlessLattice lattice(room.mesh, aligned.map, room.is_feature);
#pragma once

#include "majorant/framework/run_record.h"
#include "majorant/maps/bezier_map.h"
#include "majorant/parametrization/initialization/start.h"
#include "majorant/quads/internal/border.h"

namespace majorant {

struct AlignedMap {
  BezierMap map;
  Status status;  // of its optimization, which a limit may have ended
};

// how: its aligned edges become those of the surface, where this has any. Throws Error(Infeasible)
// for cones of one quarter turn, and where the field cannot follow the border and features; else as
// make_seamless().
AlignedMap aligned_map(const RoomySurface& surface, SeamlessOptions how, RunRecord& record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
