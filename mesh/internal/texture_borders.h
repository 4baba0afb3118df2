// Where the texture coordinates of a file are cut into islands.
#pragma once

#include <vector>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// Half-edges (3 #F flags, both sides) across which the two faces use different texture coordinates
// of the file. Files in which no two polygons share one, a soup, are cut where the values differ.
// Every corner must have texture coordinates.
std::vector<char> texture_borders(const SurfaceMesh& mesh);

}  // namespace majorant
