// Which vertices of a surface leave, in which order, until few faces are left.
//
//   CollapsingMesh left(mesh->faces(), mesh->opposites(), mesh->vertex_count());
//   decimate(left, mesh->positions(), {400, mesh->boundary_flags()});   // the boundary stays
//
// In rounds: every vertex is given its best neighbour to collapse onto, by how far the surface
// moves and how flat the new triangles are, and of the better half of them, in the order of that
// cost, all leave that have no neighbour which left in the same round. So a round looks at every
// vertex once, needs no queue, and depends on no order but that of the vertices. Not for
// rendering: features are not looked for.
#pragma once

#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/framework/types.h"
#include "majorant/parametrization/initialization/internal/collapsing_mesh.h"

namespace majorant {

struct DecimationGoal {
  Index faces;             // as few; more where nothing can leave any more
  std::vector<char> held;  // by vertex: 1 stays; empty: none does
};

// positions: #V by 3, any units. Throws Stopped.
void decimate(CollapsingMesh& mesh, const Points3& positions, const DecimationGoal& goal,
              const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
