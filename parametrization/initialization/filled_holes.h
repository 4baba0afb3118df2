// Disks whose holes are filled with a fan around a new vertex each. The initial maps of surfaces
// with holes are computed on them.
//
//     const Cells faces = filled_faces(mesh);          // vertices beyond the mesh's: one a hole
#pragma once

#include <vector>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// Returns the boundary loop that is not filled, the longest on the surface.
const std::vector<Index>& outer_loop(const SurfaceMesh& mesh);

// Returns the faces of the surface, then those of the fans, hole by hole in the order of their
// loops.
Cells filled_faces(const SurfaceMesh& mesh);

// Returns the surface with these faces and the new vertices at the centres of their loops. Faces of
// fans may have any shape, even no area.
SurfaceMesh filled_surface(const SurfaceMesh& mesh);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
