// Bounds of the minimum of det J on a curved cell, and the proof that it is positive. Bounds come
// from the Bernstein form, by bisection of the piece with the lowest coefficient. If rounding hides
// the sign, it is computed exactly.
//
//   const CellType type{CellShape::Tetrahedron, 1};
//   const std::vector<double> nodes{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
//   const DeterminantRange range = determinant_range(type, nodes.data());
//   range.positive;                          // Proven: range.low > 0
//
// Derivatives of J are by reference coordinates: those of the unit simplex, and [0, 1] on segments.
// Every bound holds for the map whose nodes are these doubles.
//
// Not for whole meshes, whose sides must also agree: check_volume_mesh(). Not for steps of a
// solver, which ElementSpace::largest_step() bounds (elements/element_space.h).
#pragma once

#include <array>

#include "majorant/elements/determinant_bounds.h"
#include "majorant/framework/stop_check.h"
#include "majorant/volumes/volume_mesh.h"

namespace majorant {

// Bisection ends if high - low is at most this part of the larger of their magnitudes, or after a
// limited number of pieces.
inline constexpr double kRangeTolerance = 0.01;

// nodes: x, y of each node of triangles and quads, x, y, z for other shapes. Throws
// Error(Unsupported) for types without tables, and Stopped.
DeterminantRange determinant_range(const CellType& type, const double* nodes,
                                   const StopCheck& stop = {});

// Computes the sign in integers, and the bounds of the minimum that follow from it. It is the last
// stage of determinant_range(), and takes microseconds to seconds.
DeterminantRange exact_determinant_range(const CellType& type, const double* nodes,
                                         const StopCheck& stop = {});

// Returns the smallest scaled Jacobian at the points of a lattice; it is sampled, not proven. It is
// det J divided by the product of the lengths of the edges at a corner, for the affine cell with
// this J. For simplices, the corner is the one with the largest product. The value is multiplied by
// sqrt(2) for tetrahedra and 2 / sqrt(3) for triangles and wedges, so that regular cells have 1.
// nodes: x, y, z of each; normal: for triangles and quads, of length 1.
double sampled_scaled_jacobian(const CellType& type, const double* nodes, const Vector3& normal);

// Returns the point of the cell at these homogeneous coordinates. nodes: x, y, z of each.
Vector3 point_of_cell(const CellType& type, const double* nodes, const std::array<double, 6>& at);

// Throws Error(Unsupported), naming the file, for types without tables.
void require_tables(const std::string& file, const CellType& type);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
