#include "majorant/mesh/internal/polygon_crossing.h"

#include <Eigen/Geometry>

#include "majorant/framework/error.h"
#include "majorant/mesh/triangulate_polygon.h"

namespace majorant {
namespace {

// The part of the area of a polygon's triangles that may be tilted or turned away, for coordinates
// of five digits. Polygons that are bent more do not cross themselves in space.
constexpr double kAside = 1e-4;

// Returns whether the triangles over these corners are in one plane, and some face its other side.
bool disagree(const std::vector<Vector3>& corners,
              const std::vector<std::array<int, 3>>& triangles) {
  std::vector<Vector3> areas;
  Vector3 normal = Vector3::Zero();  // of the largest triangle
  double sum = 0;
  for (const auto& t : triangles) {
    const Vector3& first = corners[t[0]];
    areas.push_back((corners[t[1]] - first).cross(corners[t[2]] - first));
    if (areas.back().norm() > normal.norm()) normal = areas.back();
    sum += areas.back().norm();
  }
  if (sum == 0) return false;
  normal.normalize();
  bool is_plane = true, is_any_away = false;
  for (const Vector3& area : areas) {
    is_plane = is_plane && area.cross(normal).norm() <= kAside * sum;
    is_any_away = is_any_away || area.dot(normal) < -kAside * sum;
  }
  return is_plane && is_any_away;
}

}  // namespace

bool is_crossing(const std::vector<Vector3>& corners,
                 const std::vector<std::array<int, 3>>& triangles) {
  if (!disagree(corners, triangles)) return false;
  try {
    return disagree(corners, triangulate_polygon(corners));
  } catch (const Error&) {
    return true;
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
