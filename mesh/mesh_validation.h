// Finds the first defect of a polygon mesh that the library cannot work with, and says where it is.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <string>
#include <string_view>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/polygon_mesh.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/mesh/triangle_list.h"

namespace majorant {

// A triangle is degenerate when its height over the longest edge is at most this fraction of it.
// Angles of thinner ones have fewer than four digits left.
inline constexpr double kDegenerateHeight = 1e-12;

// Returns whether a triangle has a height over its longest edge that is more than rounding.
bool has_area(const Vector3& a, const Vector3& b, const Vector3& c);

// The same, told in few operations: false also for triangles that are nearly degenerate, or of a
// size whose fourth power is out of range.
inline bool has_clear_area(const Vector3& a, const Vector3& b, const Vector3& c) {
  constexpr double kLeast = 1e-70, kMost = 1e70, kMargin = 4;
  const Vector3 u = b - a, v = c - a;
  const double longest = std::max({u.squaredNorm(), v.squaredNorm(), (u - v).squaredNorm()});
  const double least = kMargin * kDegenerateHeight * longest;  // of twice the area
  return longest > kLeast && longest < kMost && u.cross(v).squaredNorm() > least * least;
}

// Throws InvalidArgument unless indices exist, polygons have three corners and more, positions are
// finite, and lists are parallel to polygons where they are not empty; Error(Unsupported) for a
// mesh without faces. What readers guarantee and programs may get wrong.
void require_sound_lists(const PolygonMesh& input);

// Each throws Error(Unsupported) with "file: place: what; remedy", the command that works.
void require_usable_coordinates(const PolygonMesh& input);  // range and precision
void require_proper_faces(const PolygonMesh& input, const TriangleList& list, Shapes shapes,
                          const StopCheck& stop);  // degenerate, twice
void require_manifold_edges(const PolygonMesh& input, const TriangleList& list);
void require_one_component(const PolygonMesh& input, const TriangleList& list);  // also: a soup

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
