// The cut graph: edges along which a surface is cut so that it becomes a disk.
#pragma once

#include <vector>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// Returns 3 #F flags, on both half-edges of an edge or on none, of the edges along which a
// connected surface is cut to one disk: mesh.cut_along(cut_graph(mesh, cones),
// nullptr).require_disk() holds. Every vertex of `through` (any order; repeated and boundary
// vertices are allowed) lies on the cut; a cut ends only there or at the boundary. A disk without
// such vertices is not cut; a closed surface always is.
//
// The cut of spheres and disks is at most twice as long as the shortest (a minimum spanning tree
// over shortest paths, [Meh88]), and is then shortened path by path. Handles are cut along homology
// generators: the shortest loops of a tree-cotree decomposition [EW05]. Throws Error(Usage) for a
// vertex that does not exist, and Stopped.
std::vector<char> cut_graph(const SurfaceMesh& mesh, const std::vector<Index>& through,
                            const StopCheck& stop = {});

// Does the same with a positive cost of every edge (3 #F, equal on both sides) instead of its
// length.
std::vector<char> cut_graph(const SurfaceMesh& mesh, const std::vector<Index>& through,
                            const Vec& edge_cost, const StopCheck& stop = {});

Vec edge_lengths(const SurfaceMesh& mesh);  // 3 #F

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
