// Finds the first defect of a polygon mesh that the library cannot work with, and says where it is.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

// Triangles over the vertices of a PolygonMesh.
struct TriangleList {
  std::vector<std::array<Index, 3>> triangles;
  std::vector<Index> polygon;               // by triangle
  std::vector<std::array<int, 3>> corners;  // by triangle: corner numbers within the polygon
};

// Each throws Error(Unsupported) with "file: place: what; remedy".
void require_usable_coordinates(const PolygonMesh& input);  // precision
void require_proper_faces(const PolygonMesh& input, const TriangleList& list,
                          const StopCheck& stop);  // degenerate, twice
void require_manifold_edges(const PolygonMesh& input, const TriangleList& list);
void require_one_component(const PolygonMesh& input, const TriangleList& list);  // also: a soup

// "mesh.obj:12: face 7" (line known) or "mesh.obj: face 7"; counts from 1 as files do.
std::string face_place(const PolygonMesh& input, Index polygon);

}  // namespace majorant
