// Arrays in, arrays out: a surface from positions and faces, its map back as uv of face corners (a
// mesh with texture coordinates) and as control points (all of the curved map). No files.
//
// Sample run:
//   example_arrays
#include <iostream>

#include "majorant/majorant.h"

using namespace majorant;

int main() {
  const RowMatrix V = (RowMatrix(4, 3) << 0, 0, 0, 1, 0, 0, 1, 1, 0.3, 0, 1, 0).finished();
  const Cells F = (Cells(2, 3) << 0, 1, 2, 0, 2, 3).finished();  // vertices from 0
  const auto mesh = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_arrays(V, F));
  const ParametrizationResult result = parametrize(mesh, {.map = {}});
  std::cout << result.map->corner_uv() << "\n\n" << result.map->control_uv() << "\n";
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
