// Cells of any Bezier element for ParaView: a legacy VTK file with one Bezier cell per element.
#pragma once

#include <fstream>
#include <string>

#include "majorant/elements/element_space.h"

namespace majorant {

// x: `dim` numbers per node; type: VTK's cell type (77 quadrilateral, 78 tetrahedron, 79
// hexahedron of any degree).
inline void write_vtk(const std::string& path, const ElementSpace& space, const Vec& x, int dim,
                      int type) {
  std::ofstream out(path);
  out << "# vtk DataFile Version 4.2\nmajorant\nASCII\nDATASET UNSTRUCTURED_GRID\n";
  out.precision(17);
  out << "POINTS " << space.node_count() << " double\n";
  for (Index k = 0; k < space.node_count(); ++k)
    for (int c = 0; c < 3; ++c) out << (c < dim ? x[dim * k + c] : 0.0) << (c < 2 ? ' ' : '\n');
  const int nodes = space.nodes_per_element();
  out << "CELLS " << space.element_count() << ' ' << space.element_count() * (nodes + 1) << '\n';
  for (Index e = 0; e < space.element_count(); ++e)
    out << nodes << ' ' << space.cells().row(e) << '\n';
  out << "CELL_TYPES " << space.element_count() << '\n';
  for (Index e = 0; e < space.element_count(); ++e) out << type << '\n';
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
