// VTK's numbers of cell types (vtkCellType.h).
#pragma once

#include <optional>

#include "majorant/volumes/volume_mesh.h"

namespace majorant {

inline constexpr long long kLinearWedge = 13;

struct VtkType {
  CellShape shape;
  int degree;  // 0: what the number of points says
  NodeKind kind = NodeKind::Uniform;
  NodeSet set = NodeSet::Full;
};
std::optional<VtkType> vtk_type(long long number);  // none: not supported
bool is_vtk_pyramid(long long number);

// Lagrange and Bezier hexahedra, whose nodes had another order before the file version 2.1.
bool is_lattice_hexahedron(long long number);

// VTK's number of a cell with these nodes; Gauss-Lobatto nodes are written as control points. The
// quadratic cells have the nodes of Lagrange cells of degree 2, in their order, and are known to
// more programs.
int vtk_number(const CellType& type);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
