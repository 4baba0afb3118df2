#include "majorant/parametrization/initialization/strip_unfolding.h"

#include <Eigen/Geometry>
#include <deque>
#include <vector>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {
namespace {

// Returns the third corner of the face of h in a frame whose first axis is h: along, above.
Vector2 apex(const SurfaceMesh& mesh, Index h) {
  const auto point = [&](Index v) -> Vector3 { return mesh.positions().row(v).transpose(); };
  const Vector3 from = point(mesh.from_vertex(h));
  const Vector3 base = point(mesh.to_vertex(h)) - from;
  const Vector3 side = point(mesh.from_vertex(previous(h))) - from;
  const double length = base.norm();
  if (!(length > 0)) return {side.norm(), 0};
  return {side.dot(base) / length, base.cross(side).norm() / length};
}

}  // namespace

Vec unfolded(const SurfaceMesh& mesh) {
  Vec x = Vec::Zero(2 * mesh.vertex_count());
  std::vector<char> is_placed(to_size(mesh.vertex_count()), 0),
      is_seen(to_size(mesh.face_count()), 0);
  const auto place = [&](Index v, const Vector2& p) {
    if (is_placed[v]) return;
    is_placed[v] = 1;
    x.segment<2>(2 * v) = p;
  };
  std::deque<Index> front{0};  // half-edges whose two ends are placed
  is_seen[0] = 1;
  place(mesh.from_vertex(0), {0, 0});
  place(mesh.to_vertex(0), {mesh.edge_length(0), 0});
  while (!front.empty()) {
    const Index h = front.front();
    front.pop_front();
    const Vector2 from = x.segment<2>(2 * mesh.from_vertex(h));
    const Vector2 along = (x.segment<2>(2 * mesh.to_vertex(h)) - from).normalized();
    const Vector2 third = apex(mesh, h);
    place(mesh.from_vertex(previous(h)),
          from + third.x() * along + third.y() * Vector2(-along.y(), along.x()));
    for (const Index side : {h, next(h), previous(h)}) {
      const Index o = mesh.opposite(side);
      if (o < 0 || is_seen[face_of(o)]) continue;
      is_seen[face_of(o)] = 1;
      front.push_back(o);
    }
  }
  const Vector2 mean = x.reshaped(2, mesh.vertex_count()).rowwise().mean();
  x.reshaped(2, mesh.vertex_count()).colwise() -= mean;
  return x;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
