// Costs of cuts, edge by edge: the length, reduced along creases and increased where a seam is
// visible.
//
//   const Vec cost = cut_costs(*mesh, CutOptions().preferences);
//   is_cut = cut_graph(*mesh, {}, cost, {});
#pragma once

#include <vector>

#include "majorant/mesh/surface_mesh.h"
#include "majorant/parametrization/seams/choose_cuts.h"

namespace majorant {

// Returns the normal of a face; its length is twice the face's area.
Vector3 area_vector(const SurfaceMesh& mesh, Index face);

// Returns whether an edge with two faces runs inside a polygon of the file.
bool is_inner(const SurfaceMesh& mesh, Index half_edge);

// Returns the angle between the normals of the two faces, radians in 0..pi (3 #F); 0 at the
// boundary and inside polygons of the file.
Vec dihedral_angles(const SurfaceMesh& mesh);

// Returns the sharpness of edges, 3 #F in 0..1, both sides the same: 1 on creases (3 #F flags, or
// empty) and where the surface bends by a large angle.
Vec sharpness(const SurfaceMesh& mesh, const std::vector<char>& creases);

// Returns the cost of a cut along each half-edge (3 #F, positive, both sides of an edge the same):
// its length times its weight, a quarter of it along creases, a million times as much inside
// polygons of the file.
Vec cut_costs(const SurfaceMesh& mesh, const CutPreferences& preferences);
// Returns these costs, multiplied by kAvoidedCost at vertices with is_whole (#V).
Vec cut_costs(const SurfaceMesh& mesh, const CutPreferences& preferences,
              const std::vector<char>& is_whole);

// The factor of the cost of edges that cuts avoid, for example at vertices that stay whole: more
// than any detour, less than a path through a polygon.
inline constexpr double kAvoidedCost = 1e4;

// Returns the angle defects: a full turn minus the angles around a vertex; 0 on the boundary (#V).
Vec angle_defects(const SurfaceMesh& mesh);
// The least angle defect of a curved vertex, radians; above the rounding of files with 4 digits.
inline constexpr double kCurved = 1e-3;

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
