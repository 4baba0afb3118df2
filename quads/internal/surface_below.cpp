#include "majorant/quads/internal/surface_below.h"

#include <algorithm>

#include "majorant/mesh/geometry.h"
#include "majorant/quads/exact_normals.h"

namespace majorant {

std::vector<Index> faces_at(const SurfaceMesh& mesh, const NearestPoint& point) {
  constexpr double kOnEdge = 1e-9;
  std::vector<Index> faces = {point.face}, corners;
  for (Index k = 0; k < 3; ++k)
    if (point.barycentric[k] > kOnEdge) corners.push_back(3 * point.face + k);
  if (corners.size() == 2) {
    const Index along = next(corners[0]) == corners[1] ? corners[0] : corners[1];
    if (const Index o = mesh.opposite(along); o >= 0) faces.push_back(face_of(o));
  } else if (corners.size() == 1) {
    const auto is_other = [&](Index h) { return h >= 0 && face_of(h) != point.face; };
    for (Index h = mesh.opposite(corners[0]); is_other(h); h = mesh.opposite(next(h)))
      faces.push_back(face_of(h));
    for (Index h = mesh.opposite(previous(corners[0])); is_other(h); h = mesh.opposite(previous(h)))
      faces.push_back(face_of(h));
  }
  return faces;
}

Points3 positions_in_file(const SurfaceMesh& mesh) {
  return mesh.positions().rowwise() + mesh.origin().transpose();
}

SurfaceBelow::SurfaceBelow(const SurfaceMesh& surface)
    : surface_(surface),
      positions_(positions_in_file(surface)),
      tree_(positions_, surface.faces()),
      close_(kTenDigits * diagonal(positions_)) {}

// Returns the sign of n . N.
int SurfaceBelow::sign_against(const std::array<Vector3, 4>& p, Index face) const {
  const auto corner = [&](int k) { return Vector3(positions_.row(surface_.faces()(face, k))); };
  const Vector3 a = corner(0), b = corner(1), c = corner(2);
  return sign_of_normals({p[0], p[2]}, {p[1], p[3]}, {a, b}, {a, c});
}

SurfaceBelow::AtCorner SurfaceBelow::at_corner(const std::array<Vector3, 4>& corners,
                                               const NearestFaces& near) const {
  const double longest =
      std::max((corners[2] - corners[0]).norm(), (corners[3] - corners[1]).norm());
  AtCorner at;
  at.is_on_surface = near.distance <= kOnSurface * longest + close_;
  at.is_away = true;
  for (const Index f : near.faces) {
    const int sign = sign_against(corners, f);
    at.agrees |= sign > 0;
    at.is_away &= sign < 0;
  }
  return at;
}

bool SurfaceBelow::is_away_at_middle(const std::array<Vector3, 4>& corners,
                                     const NearestPoint& nearest) const {
  const auto is_away_at = [&](const NearestPoint& point) {
    const std::vector<Index> faces = faces_at(surface_, point);
    return std::any_of(faces.begin(), faces.end(),
                       [&](Index f) { return sign_against(corners, f) < 0; });
  };
  if (!is_away_at(nearest)) return false;
  // Half way through a plate both sides are equally near, and one of them agrees.
  const Vector3 middle = (corners[0] + corners[1] + corners[2] + corners[3]) / 4;
  const std::vector<Index> faces = faces_near(middle, nearest.face).faces;
  return std::all_of(faces.begin(), faces.end(), [&](Index f) {
    const auto corner = [&](Index k) -> Vector3 {
      return positions_.row(surface_.faces()(f, k)).transpose();
    };
    NearestPoint point = nearest_of_triangle(corner(0), corner(1), corner(2), middle);
    point.face = f;
    return is_away_at(point);
  });
}

bool SurfaceBelow::is_away(const std::array<Vector3, 4>& corners,
                           const NearestPoint& nearest) const {
  if (!is_away_at_middle(corners, nearest)) return false;
  return !std::all_of(corners.begin(), corners.end(), [&](const Vector3& p) {
    const AtCorner at = at_corner(corners, faces_near(p, nearest.face));
    return at.is_on_surface && at.agrees;
  });
}

bool SurfaceBelow::is_turned(const std::array<Vector3, 4>& corners, const NearestPoint& nearest,
                             const std::array<const NearestFaces*, 4>& near) const {
  constexpr int kMaximum = 2;
  bool all_agree = true;
  int away = 0;
  for (const NearestFaces* faces : near) {
    const AtCorner at = at_corner(corners, *faces);
    all_agree &= at.is_on_surface && at.agrees;
    away += at.is_on_surface && at.is_away;
  }
  return away > kMaximum || (!all_agree && is_away_at_middle(corners, nearest));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
