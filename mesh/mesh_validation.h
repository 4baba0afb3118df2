// Finds the first defect for which the library refuses a polygon mesh, and its place.
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

// A triangle is degenerate if its height over the longest edge is at most this fraction of that
// edge. Angles of thinner triangles have fewer than four correct digits.
inline constexpr double kDegenerateHeight = 1e-12;

// Returns whether the height of a triangle over its longest edge exceeds rounding.
bool has_area(const Vector3& a, const Vector3& b, const Vector3& c);

// A faster test: also false for triangles that are nearly degenerate, or of a size whose fourth
// power is out of range.
inline bool has_clear_area(const Vector3& a, const Vector3& b, const Vector3& c) {
  constexpr double kLeast = 1e-70, kMost = 1e70, kMargin = 4;
  const Vector3 u = b - a, v = c - a;
  const double longest = std::max({u.squaredNorm(), v.squaredNorm(), (u - v).squaredNorm()});
  const double least = kMargin * kDegenerateHeight * longest;  // of twice the area
  return longest > kLeast && longest < kMost && u.cross(v).squaredNorm() > least * least;
}

// Throws InvalidArgument unless all indices exist, polygons have at least three corners, positions
// are finite, and non-empty lists are parallel to polygons. Throws Error(Unsupported) for a mesh
// without faces. Readers guarantee all of this; programs may not.
void require_sound_lists(const PolygonMesh& input);

// Each throws Error(Unsupported) with "file: place: defect; remedy", where the remedy is a command.
void require_usable_coordinates(const PolygonMesh& input);  // range and precision
void require_proper_faces(const PolygonMesh& input, const TriangleList& list, Shapes shapes,
                          const StopCheck& stop);  // degenerate, twice
void require_manifold_edges(const PolygonMesh& input, const TriangleList& list);
void require_one_component(const PolygonMesh& input, const TriangleList& list);  // also refuses a
                                                                                 // soup

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
