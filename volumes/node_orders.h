// The order of the nodes of a cell, which is VTK's: lists of exponents, as
// BernsteinElement::lattice has them.
#pragma once

#include <array>
#include <vector>

#include "majorant/elements/bernstein_space.h"
#include "majorant/volumes/volume_mesh.h"

namespace majorant {

// Nodes in VTK's order, which CellBlock has: exponents of the homogeneous coordinates, of segments
// too; of points there is one.
std::vector<Exponents> vtk_order(CellShape shape, int degree);
// The weights of each on the corners, products of exponents: they add to degree^(number of
// factors).
std::vector<std::array<int, 8>> corner_weights(CellShape shape, int degree);

// The nodes of a cell that is turned around: node k is where node reflected_nodes()[k] was. These
// two are of shapes of two or three dimensions.
const std::vector<int>& reflected_nodes(const CellType& type);
// The control points of a cell with these nodes, a row each.
Points3 control_points_of(const CellType& type, Points3 nodes);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
