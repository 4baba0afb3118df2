// Finds the first defect of a polygon mesh that the library cannot work with, and says where it is.
#pragma once

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
