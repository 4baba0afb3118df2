// Between which bounds is the minimum of det J on a curved cell, and is it positive? In Bernstein
// form, by bisection of the piece with the lowest coefficient; where rounding hides the sign,
// exactly.
//
//   const CellType type{CellShape::Tetrahedron, 1};
//   const std::vector<double> nodes{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
//   const DeterminantRange range = determinant_range(type, nodes.data());
//   range.positive;                          // Proven: range.low > 0
//
// det J is by reference coordinates: those of the unit simplex, and [0, 1] on segments. Every bound
// holds for the map of the nodes as the doubles they are.
//
// Not for whole meshes, whose sides must agree, too: check_volume_mesh(). Not for steps of a
// solver, which ElementSpace::largest_step() bounds (elements/element_space.h).
#pragma once

#include <array>

#include "majorant/elements/determinant_bounds.h"
#include "majorant/framework/stop_check.h"
#include "majorant/volumes/volume_mesh.h"

namespace majorant {

// Bisection ends where high - low is at most this part of the larger of their magnitudes, if it
// takes few pieces to get there.
inline constexpr double kRangeTolerance = 0.01;

// nodes: of triangles and quads x, y of each, of others x, y, z. Throws Error(Unsupported) for
// types without tables; Stopped.
DeterminantRange determinant_range(const CellType& type, const double* nodes,
                                   const StopCheck& stop = {});

// The sign alone, in integers, and bounds of the minimum that follow. What determinant_range() ends
// with; microseconds to seconds.
DeterminantRange exact_determinant_range(const CellType& type, const double* nodes,
                                         const StopCheck& stop = {});

// The least scaled Jacobian at the points of a lattice: det J over the product of the lengths of
// the edges at a corner, of the affine cell that has this J; of simplices at the corner where that
// product is largest, times sqrt(2) of tetrahedra and 2 / sqrt(3) of triangles and wedges, so that
// regular cells have 1. nodes: x, y, z of each; normal: of triangles and quads, of length 1.
// Looked at, not proven.
double sampled_scaled_jacobian(const CellType& type, const double* nodes, const Vector3& normal);

// The point of the cell with these homogeneous coordinates. nodes: x, y, z of each.
Vector3 point_of_cell(const CellType& type, const double* nodes, const std::array<double, 6>& at);

// Throws Error(Unsupported) that names the file for types without tables.
void require_tables(const std::string& file, const CellType& type);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
