// The edges at which the texture coordinates of a file form the borders of islands.
#pragma once

#include <vector>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// Returns whether the corners of a face have texture coordinates; either all or none have.
bool is_textured(const SurfaceMesh& mesh, Index face);
// Returns the number of polygons of the file without texture coordinates.
Index untextured_polygons(const SurfaceMesh& mesh);

// Returns the half-edges (3 #F flags, both sides) whose two faces use different texture coordinates
// of the file, or of which one face has none. If no two polygons of a file share a texture
// coordinate (a soup), values are compared instead.
std::vector<char> texture_borders(const SurfaceMesh& mesh);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
