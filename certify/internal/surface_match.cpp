#include "majorant/certify/internal/surface_match.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "majorant/certify/internal/edge_match.h"
#include "majorant/certify/internal/face_match.h"
#include "majorant/certify/internal/match_tolerance.h"

namespace majorant {

const std::vector<Index> ShownCells::kNothing;
const std::vector<char> ShownCells::kNoFlags;

SurfaceMatch match_surface(const ShownCells& cells, const PolygonMesh& surface,
                           Orientation orientation) {
  SurfaceMatch match = match_along_edges(cells, surface);
  if (match.defect.empty()) return match;
  return match_faces(cells, surface, orientation).value_or(match);
}

double match_distance(const ShownCells& cells, const PolygonMesh& surface) {
  Eigen::AlignedBox3d box;
  for (const Index v : surface.polygons.indices()) box.extend(surface.positions[v]);
  return match_tolerance(box) + cells.rounding;
}

NamedVertices name_vertices(const ShownCells& cells, const PolygonMesh& surface,
                            const std::vector<char>& is_used, double close) {
  NamedVertices names;
  names.of_cells.reserve(to_size(cells.mesh.vertex_count()));
  for (Index v = 0; v < cells.mesh.vertex_count(); ++v) {
    const Index name = cells.mesh.input_vertex(v);
    const bool is_known = to_size(name) < is_used.size() && is_used[name];
    if (!is_known && !cells.face.empty())
      names.defect = fmt::format("the surface has no vertex {}", name);
    if (is_known && !((cells.mesh.input_position(v) - surface.positions[name]).norm() <= close))
      names.defect = fmt::format("vertex {} is not where the surface has it", name);
    if (!names.defect.empty()) return names;
    names.of_cells.push_back(is_known ? name : NamedVertices::kNew);
  }
  return names;
}

Vector3 area_vector(std::span<const Vector3> corners) {
  Vector3 sum = Vector3::Zero();
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    sum += (corners[k] - corners[0]).cross(corners[k + 1] - corners[0]) / 2;
  return sum;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
