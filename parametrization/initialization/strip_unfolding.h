// The start of strips: faces laid into the plane one beside the other, each as it is in space.
#pragma once

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// u, v per vertex, model units, mean 0: the first face is laid down, then every vertex where the
// first face that reaches it over an edge, breadth first, has it. An isometry of strips without
// inner vertices and of whatever is developable, however long; of curved surfaces no map at all:
// callers look at signs, and at overlaps. mesh: connected. Faces without an area are laid flat.
Vec unfolded(const SurfaceMesh& mesh);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
