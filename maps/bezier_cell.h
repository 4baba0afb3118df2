// The local geometry of a Bezier triangle in files: VTK's order of the control points, and samples
// for writers. It does not use the solver's element tables, so that files are checked against a
// second formulation.
//
// A control point has a multi-index (i, j, k), i + j + k = n: i belongs to corner 0, j to corner 1,
// k to corner 2. VTK's order: the 3 corners, the inner points of edges 01, 12, 20 in edge
// direction, then the interior as a triangle of degree n - 3, recursively.
#pragma once

#include <array>
#include <vector>

#include "majorant/elements/bernstein.h"
#include "majorant/framework/types.h"

namespace majorant {

// The highest degree of files that are read. VTK has no cells beyond 10. Chosen, not tuned.
inline constexpr int kHighestFileDegree = 32;

// Returns the number of control points of degree n.
constexpr Index bezier_cell_size(int degree) { return (degree + 1) * (degree + 2) / 2; }

// Returns the degree whose cells have `size` control points; 0 if there is none in
// 1..kHighestFileDegree.
int bezier_cell_degree(long long size);

// Returns #(n+1)(n+2)/2 multi-indices in VTK order.
std::vector<std::array<int, 3>> bezier_multi_indices(int degree);

// Returns local numbers of the n+1 control points along edge 0 (corners 0 to 1), 1 (1 to 2) or 2 (2
// to 0), ends included.
std::vector<int> bezier_edge_points(int degree, int edge);

// Returns the Bernstein polynomials of the degree at points given by barycentric coordinates (#S by
// 3): #S by (n+1)(n+2)/2, columns in VTK order.
Eigen::MatrixXd bernstein_values(int degree, const Points3& barycentric);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
