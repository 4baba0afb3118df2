#include "majorant/mesh/plane_side.h"

#include <algorithm>
#include <span>

namespace majorant {
namespace {

double twice_area(const PolygonMesh& mesh, std::size_t polygon) {
  const auto& corners = mesh.polygons[polygon];
  const auto at = [&](std::size_t k) { return Vector2(mesh.positions[corners[k]].head<2>()); };
  double sum = 0;
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    sum += cross(Vector2(at(k) - at(0)), Vector2(at(k + 1) - at(0)));
  return sum;
}

}  // namespace

std::optional<PolygonMesh> turned_counterclockwise(const PolygonMesh& mesh) {
  if (mesh.polygons.empty()) return {};
  const auto [low, high] = std::minmax_element(
      mesh.polygons.indices().begin(), mesh.polygons.indices().end(),
      [&](Index a, Index b) { return mesh.positions[a].z() < mesh.positions[b].z(); });
  double size = 0, area = 0;
  const Vector3& origin = mesh.positions[mesh.polygons[0][0]];
  for (const Index v : mesh.polygons.indices())
    size = std::max(size, (mesh.positions[v] - origin).cwiseAbs().maxCoeff());
  if (!(mesh.positions[*high].z() - mesh.positions[*low].z() <= kTenDigits * size)) return {};
  for (std::size_t p = 0; p < mesh.polygons.size(); ++p) {
    const double twice = twice_area(mesh, p);
    if (twice > 0) return {};
    area += twice;
  }
  if (!(area < 0)) return {};
  PolygonMesh turned = mesh;
  for (IndexLists* lists : {&turned.polygons, &turned.polygon_texcoords, &turned.polygon_normals})
    for (std::size_t p = 0; p < lists->size(); ++p) {
      const std::span<Index> list = (*lists)[p];
      std::reverse(list.begin(), list.end());
    }
  return turned;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
