#include "majorant/certify/internal/glued_map.h"

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "majorant/mesh/repair.h"

namespace majorant {
namespace {

// Returns the group of the faces around each vertex; -1 if they are in several groups.
std::vector<Index> group_of_vertices(const SurfaceMesh& mesh, const std::vector<Index>& group) {
  std::vector<Index> of_vertex(to_size(mesh.vertex_count()), 0);
  if (group.empty()) return of_vertex;
  std::vector<char> is_known(of_vertex.size(), 0);
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (Index k = 0; k < 3; ++k) {
      const std::size_t v = to_size(mesh.faces()(f, k));
      const bool is_other = is_known[v] && of_vertex[v] != group[to_size(f)];
      of_vertex[v] = is_other ? -1 : group[to_size(f)];
      is_known[v] = 1;
    }
  return of_vertex;
}

// Returns for every boundary vertex the first one of its group with the same place and uv, for
// inner vertices themselves.
std::vector<Index> first_of_equals(const BezierMap& map, const std::vector<Index>& group) {
  const std::vector<char> is_boundary = map.mesh().boundary_flags();
  const std::vector<Index> of_vertex = group_of_vertices(map.mesh(), group);
  std::map<std::pair<Index, std::array<double, 5>>, Index> known;
  std::vector<Index> first(is_boundary.size());
  for (Index v = 0; v < map.mesh().vertex_count(); ++v) {
    first[v] = v;
    if (!is_boundary[v] || of_vertex[v] < 0) continue;
    const Vector3 p = map.mesh().positions().row(v);
    const Vector2 uv = map.control_points().segment<2>(2 * v);
    const std::array<double, 5> place{p.x(), p.y(), p.z(), uv.x(), uv.y()};
    first[v] = known.try_emplace({of_vertex[v], place}, v).first->second;
  }
  return first;
}

}  // namespace

std::optional<BezierMap> glued(const BezierMap& map, const std::vector<Index>& group) {
  const std::vector<Index> first = first_of_equals(map, group);
  PolygonMesh welded;
  welded.file = map.mesh().file();
  for (Index v = 0; v < map.mesh().vertex_count(); ++v)
    welded.positions.push_back(map.mesh().positions().row(v));
  bool is_other = false;
  for (Index f = 0; f < map.mesh().face_count(); ++f) {
    std::array<Index, 3> corners;
    for (Index k = 0; k < 3; ++k) {
      const Index v = map.mesh().faces()(f, k);
      is_other = is_other || first[v] != v;
      corners[to_size(k)] = first[v];
    }
    welded.polygons.push_back(corners);
  }
  if (!is_other) return std::nullopt;
  const auto mesh =
      repair(welded, {.orientation = Orientation::AsGiven, .numerics = Numerics::AsGiven}).mesh;
  auto space = std::make_shared<const BezierTriangleSpace>(mesh->faces(), mesh->vertex_count(),
                                                           map.degree());
  Vec x(2 * space->node_count());
  std::vector<char> is_set(to_size(space->node_count()), 0);
  for (Index f = 0; f < mesh->face_count(); ++f)
    for (Index k = 0; k < space->nodes_per_element(); ++k) {
      const Index node = space->cells()(f, k);
      const Vector2 uv = map.control_points().segment<2>(2 * map.space().cells()(f, k));
      if (is_set[node] && Vector2(x.segment<2>(2 * node)) != uv) return std::nullopt;
      x.segment<2>(2 * node) = uv;
      is_set[node] = 1;
    }
  return BezierMap(mesh, std::move(space), std::move(x));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
