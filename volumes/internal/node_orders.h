// In which order formats have the nodes of a cell: lists of exponents, as VTK's order has them for
// BernsteinElement::lattice, and where each stands there.
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

// gmsh's order of the nodes of a cell: of each the place in VTK's.
std::vector<int> gmsh_order(const CellType& type);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
