// Finds the first defect of a polygon mesh that the library cannot work with, and says where it is.
#pragma once

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/internal/triangle_list.h"
#include "majorant/mesh/polygon_mesh.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// Whether a triangle has a height over its longest edge that is more than rounding.
bool has_area(const Vector3& a, const Vector3& b, const Vector3& c);

// Each throws Error(Unsupported) with "file: place: what; remedy".
void require_usable_coordinates(const PolygonMesh& input);  // precision
void require_proper_faces(const PolygonMesh& input, const TriangleList& list, Shapes shapes,
                          const StopCheck& stop);  // degenerate, twice
void require_manifold_edges(const PolygonMesh& input, const TriangleList& list);
void require_one_component(const PolygonMesh& input, const TriangleList& list);  // also: a soup

}  // namespace majorant
