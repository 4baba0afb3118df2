// Finds and merges vertices at one position, or close to each other.
#pragma once

#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

// Returns whether a mesh of two or more polygons has no vertex that two of them share, as in STL
// files and exported soups.
bool is_soup(const PolygonMesh& mesh);

// Returns for every vertex the smallest vertex at exactly its position; the vertex itself if there
// is none, or no polygon uses it.
std::vector<Index> first_at_place(const PolygonMesh& mesh);
// Returns the vertices, ascending, that polygons use and that lie exactly at a smaller such vertex.
std::vector<Index> coincident_vertices(const PolygonMesh& mesh);

// Returns whether two corners of a polygon lie at one place.
bool has_corners_at_one_place(const PolygonMesh& mesh, Index polygon);

// Returns the median of the shortest edges of the polygons. A longer distance would weld corners of
// most polygons to each other, and tear the surface into shards. Infinite if no edge has a length.
double usable_weld_distance(const PolygonMesh& mesh);

// Returns for every vertex the smallest vertex to which it is welded; the vertex itself if it is
// not welded, or no polygon uses it. Vertices at most `distance` apart are welded, also in chains;
// 0: equal positions. Takes O(n log n) unless very many vertices lie within the distance.
std::vector<Index> weld(const PolygonMesh& mesh, double distance, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
