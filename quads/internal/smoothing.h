// Laplacian smoothing of quads on a surface that neither folds quads nor turns them over.
//
// Each vertex v moves towards (1 - s) mean(neighbours) + s x_v^0, with its place x_v^0 in the map
// and s = 1/2, by the largest of the steps 1, 1/2, 1/4 after which
//     q(v) >= min(q(v) before, sin 30 degrees)
// for the least corner q(v) around it (movable_quads.h), and no more of its quads face away from
// the surface. Remaining bad quads are repaired one vertex at a time, and untangled (untangling.h).
//
//   HeldVertices held;
//   held.points.resize(polygons.positions.size());   // no vertex on the border or on a feature
//   smooth_quads(polygons, *mesh, held, stop);
//
// Vertices of the border and of features slide along these between their neighbours; corners stay.
#pragma once

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/polygon_mesh.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/quads/internal/movable_quads.h"

namespace majorant {

// mesh: a manifold of quads, in the units and places of the file that the surface came from.
// Vertices that move end on the surface. Throws Stopped.
void smooth_quads(PolygonMesh& mesh, const SurfaceMesh& surface, const HeldVertices& held,
                  const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
