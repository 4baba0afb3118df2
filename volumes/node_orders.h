// The order of the nodes of a cell, which is that of VTK: lists of exponents, as in
// BernsteinElement::lattice.
#pragma once

#include <array>
#include <vector>

#include "majorant/elements/bernstein_space.h"
#include "majorant/volumes/volume_mesh.h"

namespace majorant {

// Returns the nodes in VTK's order, as in CellBlock: exponents of the homogeneous coordinates, also
// for segments; a point has one node.
std::vector<Exponents> vtk_order(CellShape shape, int degree);
// Returns the weights of each node on the corners, products of exponents; their sum is
// degree^(number of factors).
std::vector<std::array<int, 8>> corner_weights(CellShape shape, int degree);

// Returns the nodes of a turned cell: node k is at the former node reflected_nodes()[k]. This and
// the next function are for shapes of two or three dimensions.
const std::vector<int>& reflected_nodes(const CellType& type);
// Returns the control points of a cell with these nodes, one a row.
Points3 control_points_of(const CellType& type, Points3 nodes);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
