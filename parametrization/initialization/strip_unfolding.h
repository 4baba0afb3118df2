// The initial map of strips: faces laid into the plane side by side, each with its shape in space.
#pragma once

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// Returns u, v per vertex, model units, mean 0. The first face is laid down, then every vertex
// where the first face that reaches it over an edge, breadth first, places it. For strips without
// inner vertices and other developable surfaces that is an isometry, however long they are. For
// curved surfaces it is no valid map, so callers test signs and overlaps. mesh: connected. Faces
// without an area are laid flat.
Vec unfolded(const SurfaceMesh& mesh);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
