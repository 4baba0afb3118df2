// Vertices of quads moved on a surface towards the middle of their neighbours, which neither folds
// nor turns: no step makes the worst corner around it worse than before, unless it stays good, or
// more of its quads face away from the surface.
//
//   const std::vector<BorderPoint> border(polygons.positions.size());   // no vertex on the border
//   smooth_quads(polygons, *mesh, border, stop);
//
// Vertices of the border slide along it, between their neighbours, but for its corners.
#pragma once

#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/polygon_mesh.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/quads/internal/border.h"

namespace majorant {

// mesh: of quads, a manifold, in the units and places of the file that the surface came from.
// border: for every vertex of it. Vertices that move end on the surface. Throws Stopped.
void smooth_quads(PolygonMesh& mesh, const SurfaceMesh& surface,
                  const std::vector<BorderPoint>& border, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
