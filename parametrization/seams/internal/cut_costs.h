// Costs of cuts, edge by edge: the length, less along creases, more where a seam shows.
//
//   const Vec cost = cut_costs(*mesh, CutOptions().wanted);
//   is_cut = cut_graph(*mesh, {}, cost, {});
#pragma once

#include <vector>

#include "majorant/mesh/surface_mesh.h"
#include "majorant/parametrization/seams/choose_cuts.h"

namespace majorant {

// The normal of a face, as long as twice its area.
Vector3 area_vector(const SurfaceMesh& mesh, Index face);

// Returns whether an edge with two faces runs inside a polygon of the file.
bool is_inner(const SurfaceMesh& mesh, Index half_edge);

// 3 #F, radians in 0..pi: the angle between the normals of the two faces; 0 at the boundary and
// inside polygons of the file.
Vec dihedral_angles(const SurfaceMesh& mesh);

// 3 #F in 0..1, both sides the same: 1 on creases (3 #F flags, or empty) and where the surface
// bends by a large angle.
Vec sharpness(const SurfaceMesh& mesh, const std::vector<char>& creases);

// The cost of a cut along each half-edge (3 #F, positive, both sides of an edge the same): its
// length times its weight, a quarter of it along creases, a million times as much inside polygons
// of the file.
Vec cut_costs(const SurfaceMesh& mesh, const CutPreferences& preferences);
// These costs, ten thousand times as much at vertices with is_whole (#V).
Vec cut_costs(const SurfaceMesh& mesh, const CutPreferences& preferences,
              const std::vector<char>& is_whole);

// Factor of the cost of edges that are avoided, at vertices that stay whole for example: more than
// ways around them, less than ways through a polygon.
inline constexpr double kAvoidedCost = 1e4;

// #V: what the angles around a vertex lack of a full turn; 0 on the boundary.
Vec angle_defects(const SurfaceMesh& mesh);
// Radians: defects below are flat; files with 4 digits are.
inline constexpr double kCurved = 1e-3;

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
