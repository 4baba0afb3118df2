// Meshes of Bezier triangles of the plane in files: the scaffold around a map.
#pragma once

#include "majorant/io/map_file.h"
#include "majorant/parametrization/maps/bezier_mesh.h"

namespace majorant {

// The mesh as the identity map of itself: points are (u, v, 0), uv the same; points that faces
// share are shared. Vertices are numbered anew; there are no input vertices and faces.
MapFile to_map_file(const BezierMesh& mesh);

}  // namespace majorant
