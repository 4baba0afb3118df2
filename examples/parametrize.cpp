// The library in ten lines: flatten a mesh with cubic Bezier triangles.
//
// Sample runs:
//   example_parametrize examples/meshes/creature.obj creature.vtu
//   example_parametrize examples/meshes/cap.obj cap.vtu
#include "majorant/parametrization/solve/parametrize.h"

#include <iostream>

#include "majorant/io/io.h"
#include "majorant/io/read_mesh.h"

int main(int argc, char** argv) {
  if (argc < 3) return std::cerr << "usage: " << argv[0] << " IN.obj OUT.vtu\n", 1;
  using namespace majorant;
  // 1. Read and validate; errors say file, place and remedy.
  auto mesh = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(read_mesh(argv[1])));
  // 2. Optimize: symmetric Dirichlet, free boundary, degree 3 by default.
  ParametrizationOptions options;
  options.map.degree = 3;
  ParametrizationResult result = parametrize(mesh, options);
  // 3. Use the map.
  std::cout << status_name(result.status) << ", energy " << result.measures.value
            << ", centre of face 0 at "
            << result.map->evaluate(0, {1 / 3., 1 / 3., 1 / 3.}).transpose() << "\n";
  write_vtu(argv[2], to_map_file(*result.map));
  return result.measures.locally_injective ? 0 : 1;
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
