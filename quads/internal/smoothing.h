// Vertices of quads moved on a surface towards the middle of their neighbours, which neither folds
// nor turns: no step makes the worst corner around it worse than before, unless it stays good, or
// more of its quads face away from the surface.
//
//   smooth_quads(polygons, mesh->positions(), mesh->faces(), stop);
//
// Not for meshes with a border: all vertices move.
#pragma once

#include "majorant/framework/stop_check.h"
#include "majorant/framework/types.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

// mesh: of quads, a closed manifold. positions: #V by 3, faces: #F by 3, of the surface. Vertices
// that move end on it. Throws Stopped.
void smooth_quads(PolygonMesh& mesh, const Points3& positions, const Cells& faces,
                  const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
