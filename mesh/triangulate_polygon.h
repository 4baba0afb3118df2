// A polygon of a file as triangles.
//
//   const std::vector<Vector3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
//   for (const auto& [a, b, c] : triangulate_polygon(square)) ...   // numbers of corners
#pragma once

#include <array>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/framework/types.h"

namespace majorant {

// Triangles (local corner numbers) of a simple polygon, n - 2 of them, by ear clipping in its mean
// plane; the shape-preserving choice among valid ears is the one with the largest smallest angle.
// A polygon that crosses itself there is clipped all the same, at its least bad ears. Of more than
// 2,048 corners the constrained Delaunay triangulation is taken (large_polygon.h), which exists for
// simple ones alone: Error(Unsupported) without a place. Polls for each O(n) of work.
std::vector<std::array<int, 3>> triangulate_polygon(const std::vector<Vector3>& corners,
                                                    const StopCheck& stop = {});

// Who asks: what a writer leaves as it is, a reader accepts, though positions were rounded.
enum class PolygonUse { Written, Read };

// Returns whether a polygon of a file is in the plane what it is in space to programs that cut it
// from its corner `first`: from 0 as a rule, a quad from 0 or 1. Where all triangles of that cut
// face the side of the polygon in space, they turn in the plane as the whole polygon does, but for
// those that have no area in space. A cut that is wrong in space promises nothing: an L-shaped
// polygon has to be cut by its shape. uv: by corner.
bool is_unfolded_cut_from(std::size_t first, const std::vector<Vector3>& corners,
                          const std::vector<Vector2>& uv, PolygonUse use);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
