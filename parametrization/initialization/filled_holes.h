// Holes of a disk, filled with a fan around a new vertex each: what the starts of such surfaces are
// made on.
//
//     const Cells faces = filled_faces(mesh);          // vertices beyond the mesh's: one a hole
#pragma once

#include <vector>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// The boundary loop that stays one: the longest on the surface.
const std::vector<Index>& outer_loop(const SurfaceMesh& mesh);

// The faces of the surface, then those of the fans, hole by hole in the order of their loops.
Cells filled_faces(const SurfaceMesh& mesh);

// The surface with these faces, the new vertices in the middle of their loops. Faces of fans may be
// of any shape, also none.
SurfaceMesh filled_surface(const SurfaceMesh& mesh);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
