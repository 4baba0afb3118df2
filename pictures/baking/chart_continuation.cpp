#include "majorant/pictures/baking/chart_continuation.h"

#include <Eigen/Geometry>
#include <array>
#include <map>

#include "majorant/mesh/nearest_point.h"

namespace majorant {
namespace {

// The largest number of faces on a path; a texel needs fewer.
constexpr int kMaxFaces = 64;

using Place = std::array<double, 3>;

Place place_of(const SurfaceMesh& mesh, Index vertex) {
  const Vector3 p = mesh.positions().row(vertex);
  return {p.x(), p.y(), p.z()};
}

// Returns `point` after a rotation about the line a b into the plane of a, b, r, on the other side
// of the line than r. Unfolded, it lies on the side of r.
Vector3 unfolded(const Vector3& point, const Vector3& a, const Vector3& b, const Vector3& r) {
  const Vector3 along = (b - a).stableNormalized();
  const auto across = [&](const Vector3& p) -> Vector3 { return p - a - along.dot(p - a) * along; };
  return a + along.dot(point - a) * along + across(point).norm() * across(r).stableNormalized();
}

// Returns barycentric coordinates in the plane of the triangle; not finite without area.
Barycentric coordinates(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& p) {
  const Vector3 normal = (b - a).cross(c - a);
  const double doubled = normal.squaredNorm();
  const double at_a = (c - b).cross(p - b).dot(normal) / doubled;
  const double at_b = (a - c).cross(p - c).dot(normal) / doubled;
  return {at_a, at_b, 1 - at_a - at_b};
}

}  // namespace

ChartContinuation::ChartContinuation(const SurfaceMesh& mesh)
    : mesh_(mesh), across_(mesh.opposites()) {
  std::map<std::pair<Place, Place>, std::vector<Index>> borders;
  const auto count = static_cast<Index>(across_.size());
  for (Index h = 0; h < count; ++h)
    if (across_[h] < 0)
      borders[{place_of(mesh, from_vertex(mesh.faces(), h)),
               place_of(mesh, to_vertex(mesh.faces(), h))}]
          .push_back(h);
  for (const auto& [ends, sides] : borders) {
    const auto others = borders.find({ends.second, ends.first});
    if (sides.size() == 1 && others != borders.end() && others->second.size() == 1)
      across_[sides.front()] = others->second.front();
  }
}

SurfacePlace ChartContinuation::at(const SurfacePlace& place) const {
  SurfacePlace here = place;
  for (int faces = 0; faces < kMaxFaces; ++faces) {
    Index least = 0;
    if (here.barycentric.minCoeff(&least) >= 0) return here;
    Vector3 point = Vector3::Zero();
    for (int k = 0; k < 3; ++k) point += here.barycentric[k] * corner(here.face, k);
    const Index side = 3 * here.face + (least + 1) % 3;  // opposite to the smallest coordinate
    const Index other = across_[side];
    if (other < 0) return nearest(here.face, point);
    const Index next = face_of(other);
    const int k = corner_of(other);
    const Vector3 a = corner(next, k), b = corner(next, (k + 1) % 3), r = corner(next, (k + 2) % 3);
    const Barycentric beyond = coordinates(a, b, r, unfolded(point, a, b, r));
    if (!beyond.allFinite()) return nearest(here.face, point);
    here.face = next;
    for (int l = 0; l < 3; ++l) here.barycentric[(k + l) % 3] = beyond[l];
  }
  return {place.face, place.barycentric.cwiseMax(0.0) / place.barycentric.cwiseMax(0.0).sum()};
}

SurfacePlace ChartContinuation::nearest(Index face, const Vector3& point) const {
  return {
      face,
      nearest_of_triangle(corner(face, 0), corner(face, 1), corner(face, 2), point).barycentric};
}

Vector3 ChartContinuation::corner(Index face, int k) const {
  return mesh_.positions().row(mesh_.faces()(face, k));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
