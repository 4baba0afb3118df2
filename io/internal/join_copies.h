// Vertices that a file holds several times, for the texture coordinates on both sides of a cut, as
// one again.
#pragma once

#include <vector>

#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

// copy_of: for each vertex of the mesh the number of that which it is a copy of, not negative, from
// 0 without gaps; not empty. Afterwards these are the vertices; texture coordinates stay one a
// copy. Throws Error(Unreadable) for other numbers, or where copies are at different places.
void join_copies(PolygonMesh& mesh, const std::vector<Index>& copy_of);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
