#include "majorant/certify/internal/triangle_in_space.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "majorant/certify/internal/surface_match.h"

namespace majorant {

TriangleInSpace::TriangleInSpace(const std::array<Vector3, 3>& corners, double close)
    : corners_(corners), area_(area_vector(corners)), close_(close) {}

double TriangleInSpace::length() const {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += (corners_[(k + 1) % 3] - corners_[k]).norm();
  return sum;
}

bool TriangleInSpace::contains(const Vector3& p) const {
  if (is_flat()) return is_on_a_side(p);
  const Vector3 normal = area_.stableNormalized();
  if (!(std::abs(normal.dot(p - corners_[0])) <= close_)) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3 side = (corners_[(k + 1) % 3] - corners_[k]).stableNormalized();
    if (!(normal.cross(side).dot(p - corners_[k]) >= -close_)) return false;
  }
  return true;
}

bool TriangleInSpace::has_on_a_side(const Vector3& p, const Vector3& q) const {
  for (std::size_t k = 0; k < 3; ++k)
    if (is_on(k, p) && is_on(k, q)) return true;
  return false;
}

bool TriangleInSpace::is_on(std::size_t k, const Vector3& p) const {
  const Vector3 side = corners_[(k + 1) % 3] - corners_[k], along = side.stableNormalized();
  const double t = std::clamp((p - corners_[k]).dot(along), 0.0, side.norm());
  return (corners_[k] + t * along - p).norm() <= close_;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
