#include "majorant/quads/internal/surface_below.h"

#include <algorithm>
#include <vector>

#include "majorant/mesh/geometry.h"
#include "majorant/quads/exact_normals.h"

namespace majorant {

SurfaceBelow::SurfaceBelow(const SurfaceMesh& surface)
    : surface_(surface),
      positions_(surface.positions().rowwise() + surface.origin().transpose()),
      tree_(positions_, surface.faces()),
      close_(kTenDigits * diagonal(positions_)) {}

// The sign of n . N.
int SurfaceBelow::sign_against(const std::array<Vector3, 4>& p, Index face) const {
  const auto corner = [&](int k) { return Vector3(positions_.row(surface_.faces()(face, k))); };
  const Vector3 a = corner(0), b = corner(1), c = corner(2);
  return sign_of_normals({p[0], p[2]}, {p[1], p[3]}, {a, b}, {a, c});
}

std::array<SurfaceBelow::AtCorner, 4> SurfaceBelow::at_corners(
    const std::array<Vector3, 4>& corners, Index likely) const {
  const double longest =
      std::max((corners[2] - corners[0]).norm(), (corners[3] - corners[1]).norm());
  std::array<AtCorner, 4> found{};
  for (std::size_t k = 0; k < 4; ++k) {
    const double distance = tree_.nearest(corners[k], likely).distance;
    const std::vector<Index> faces = tree_.faces_within(corners[k], distance + close_);
    AtCorner& at = found[k];
    at.is_on_surface = distance <= kOnSurface * longest + close_;
    at.is_away = true;
    for (const Index f : faces) {
      const int sign = sign_against(corners, f);
      at.agrees |= sign > 0;
      at.is_away &= sign < 0;
    }
  }
  return found;
}

bool SurfaceBelow::is_away(const std::array<Vector3, 4>& corners,
                           const NearestPoint& nearest) const {
  const std::vector<Index> at_centroid = faces_at(surface_, nearest);
  if (std::all_of(at_centroid.begin(), at_centroid.end(),
                  [&](Index f) { return sign_against(corners, f) >= 0; }))
    return false;
  const auto found = at_corners(corners, nearest.face);
  return !std::all_of(found.begin(), found.end(),
                      [](const AtCorner& at) { return at.is_on_surface && at.agrees; });
}

bool SurfaceBelow::is_turned(const std::array<Vector3, 4>& corners,
                             const NearestPoint& nearest) const {
  constexpr std::ptrdiff_t kMost = 2;
  if (is_away(corners, nearest)) return true;
  const auto found = at_corners(corners, nearest.face);
  return std::count_if(found.begin(), found.end(),
                       [](const AtCorner& at) { return at.is_on_surface && at.is_away; }) > kMost;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
