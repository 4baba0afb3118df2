// The edges along which the texture coordinates of a file are cut into islands.
#pragma once

#include <vector>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// Returns whether the corners of a face have texture coordinates: all of them or none.
bool is_textured(const SurfaceMesh& mesh, Index face);
// Polygons of the file without.
Index untextured_polygons(const SurfaceMesh& mesh);

// Half-edges (3 #F flags, both sides) across which the two faces use different texture coordinates
// of the file, or one of them none. Files in which no two polygons share one, a soup, are cut where
// the values differ.
std::vector<char> texture_borders(const SurfaceMesh& mesh);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
