#include "majorant/parametrization/maps/bezier_map.h"

namespace majorant {

BezierMesh bezier_mesh(int degree, const Cells& faces, const Cells& cells, VecIn x) {
  BezierMesh mesh;
  mesh.degree = degree;
  mesh.faces = faces;
  mesh.opposite = opposite_half_edges(faces);
  mesh.points.resize(cells.rows(), 2 * cells.cols());
  for (Index f = 0; f < cells.rows(); ++f)
    for (Index l = 0; l < cells.cols(); ++l)
      mesh.points.row(f).segment<2>(2 * l) = x.segment<2>(2 * cells(f, l));
  return mesh;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
