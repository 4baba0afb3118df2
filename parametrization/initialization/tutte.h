// The start of disks: every vertex a mean of its neighbours.
#pragma once

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// Tutte's embedding [Tut63] with uniform weights: boundary on the circle of the surface's area
// (radius sqrt(area / pi), centre 0), counterclockwise, spaced by arc length, the first boundary
// vertex in file order at angle 0. Returns u, v per vertex, model units. Of several boundary loops
// the longest goes to the circle; the others are filled with a vertex each, so that the image has
// holes there.
//
// Where that leaves faces no room in doubles (narrow tubes, boundaries of tiny edges: exact signs
// decide), vertices lean towards the boundary instead, the boundary being
// spaced less unevenly if need be. So every face is positive, but for meshes beyond all of these.
// Needs a disk, possibly with holes; throws Error(Infeasible) when the linear system cannot be
// solved; Stopped.
Vec tutte_map(const SurfaceMesh& mesh, const StopCheck& stop = {});

// The boundary of that map where it is spaced by arc length; other vertices at 0.
Vec tutte_boundary(const SurfaceMesh& mesh);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
