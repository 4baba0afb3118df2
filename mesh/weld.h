// Vertices at one place, or close to each other.
#pragma once

#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

// Returns whether no polygon shares a vertex with another, of two or more: STL files, exported
// soups.
bool is_soup(const PolygonMesh& mesh);

// For every vertex the smallest one exactly where it is; itself where there is none, or no polygon
// uses it.
std::vector<Index> first_at_place(const PolygonMesh& mesh);
// Vertices, ascending, that lie exactly where a smaller one does; of those that a polygon uses.
std::vector<Index> coincident_vertices(const PolygonMesh& mesh);

// Returns whether two corners of a polygon lie at one place.
bool has_corners_at_one_place(const PolygonMesh& mesh, Index polygon);

// Returns the median of the shortest edges of the polygons: a longer distance would weld corners of
// most polygons to each other, and tear the surface into shards. Infinite where no edge has a
// length.
double usable_weld_distance(const PolygonMesh& mesh);

// For every vertex the smallest one that it is welded to; itself where it is not, or no polygon
// uses it. Vertices no farther apart than `distance` are welded, chains of them, too; 0: equal
// positions. O(n log n) unless very many lie within the distance.
std::vector<Index> weld(const PolygonMesh& mesh, double distance, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
