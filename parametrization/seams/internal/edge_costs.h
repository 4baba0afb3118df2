// The cost of a cut along an edge: its length, less where a seam is hidden by a sharp edge.
#pragma once

#include <vector>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// 3 #F, radians in 0..pi: the angle between the normals of the two faces; 0 at the boundary and
// inside polygons of the file.
Vec dihedral_angles(const SurfaceMesh& mesh);

// 3 #F, positive, both sides the same: lengths, down to half of them along sharp edges; a million
// times as much inside polygons of the file.
Vec cut_costs(const SurfaceMesh& mesh);

// The same, ten thousand times as much at vertices with is_whole (#V).
Vec cut_costs(const SurfaceMesh& mesh, const std::vector<char>& is_whole);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
