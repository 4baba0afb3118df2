// VTK's numbers of cell types (vtkCellType.h).
#pragma once

#include <optional>

#include "majorant/volumes/volume_mesh.h"

namespace majorant {

inline constexpr long long kLinearWedge = 13;

struct VtkType {
  CellShape shape;
  int degree;  // 0: determined by the number of points
  NodeKind kind = NodeKind::Uniform;
  NodeSet set = NodeSet::Full;
};
std::optional<VtkType> vtk_type(long long number);  // none: not supported
bool is_vtk_pyramid(long long number);

// Lagrange and Bezier hexahedra had another order of nodes before version 2.1 of the format.
bool is_lattice_hexahedron(long long number);

// Returns VTK's number of a cell type; Gauss-Lobatto nodes are written as control points. Quadratic
// cells have the same nodes as Lagrange cells of degree 2, in the same order, and more programs
// know them.
int vtk_number(const CellType& type);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
