// An energy of one's own, written as a function of the singular values, put into the solver without
// touching the library. Another density of J: see custom_density.cpp.
//
// Sample run:
//   example_custom_energy examples/meshes/cap.obj cap.vtu
#include <iostream>

#include "majorant/majorant.h"

using namespace majorant;

int main(int argc, char** argv) {
  if (argc < 3) return std::cerr << "usage: " << argv[0] << " IN.obj OUT.vtu\n", 1;
  // 1. The density: one line. S >= |s| are the signed singular values of the Jacobian. Derivatives,
  // assembly, quadrature, threads: done for you.
  auto mine = spectral("mine", [](auto S, auto s) { return S * S + s * s + 2.0 / (S * s); });
  // 2. Into the solver, here with a little of a built-in energy.
  auto mesh = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(read_mesh(argv[1])));
  ParametrizationOptions options;
  options.map.degree = 2;
  options.map.energy = {{energy_factory(mine), 1.0}, {find_energy("asap")->make, 0.1}};
  ParametrizationResult result = parametrize(mesh, options);
  write_vtu(argv[2], to_map_file(*result.map));
  // 3. While writing a new energy: its derivatives against finite differences.
  auto term = make_energy(result.map->shared_space(),
                          flat_triangles(mesh->positions(), mesh->faces()), mine);
  auto report = check_derivatives(*term, result.map->control_points());
  std::cout << status_name(result.status) << ", energy " << result.measures.value << "\n"
            << report.message();
  return result.status == Status::Converged && report.ok() ? 0 : 1;
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
