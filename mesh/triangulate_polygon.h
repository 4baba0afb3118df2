// Splits a polygon of a file into triangles.
//
//   const std::vector<Vector3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
//   for (const auto& [a, b, c] : triangulate_polygon(square)) ...   // numbers of corners
#pragma once

#include <array>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/framework/types.h"

namespace majorant {

// Returns n - 2 triangles (local corner numbers) of a simple polygon, by ear clipping in its mean
// plane. Of the valid ears, that with the largest smallest angle is clipped first. A polygon that
// crosses itself there is clipped at its least bad ears. Polygons with more than 2,048 corners use
// the constrained Delaunay triangulation (large_polygon.h), which exists only for simple polygons;
// for others it throws Error(Unsupported) without a place. Polls for each O(n) of work.
std::vector<std::array<int, 3>> triangulate_polygon(const std::vector<Vector3>& corners,
                                                    const StopCheck& stop = {});

// The purpose of a test. Read is more tolerant, so that a reader accepts what a writer wrote
// although positions were rounded.
enum class PolygonUse { Written, Read };

// Returns whether a polygon has the same shape in the plane as in space for programs that fan it
// from its corner `first` (usually 0; for a quad 0 or 1). If all triangles of that fan face the
// polygon's side in space, they must turn in the plane as the whole polygon does, except for those
// without area in space. If the fan is wrong in space, the result is true, since such a polygon (an
// L, for example) has to be cut by its shape. uv: by corner.
bool is_unfolded_cut_from(std::size_t first, const std::vector<Vector3>& corners,
                          const std::vector<Vector2>& uv, PolygonUse use);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
