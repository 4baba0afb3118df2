// A bound that is a constraint: the largest stretch of a map stays below a number, proven on every
// face, and the run converges inside the bound instead of stalling at it.
//
// Sample runs:
//   example_bounded_stretch examples/meshes/cap.obj cap.vtu
//   example_bounded_stretch examples/meshes/creature.obj creature.vtu
#include <iostream>

#include "majorant/io/io.h"
#include "majorant/io/read_mesh.h"
#include "majorant/parametrization/solve/parametrize.h"
#include "stretch_bound.h"

using namespace majorant;

int main(int argc, char** argv) {
  if (argc < 3) return std::cerr << "usage: " << argv[0] << " IN.obj OUT.vtu\n", 1;
  auto mesh = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(read_mesh(argv[1])));
  // 1. The free optimum, and its largest stretch.
  ParametrizationOptions options;
  options.map.degree = 2;
  const ParametrizationResult free = parametrize(mesh, options);
  const RestShapes rest = flat_triangles(mesh->positions(), mesh->faces());
  const double stretch =
      largest_stretch(jacobian_net(free.map->space(), rest), free.map->control_points()).maxCoeff();
  // 2. Solve again with a bound that this stretch exceeds by 20 %.
  const double bound = stretch / 1.2;
  options.extend = [&](MapExtension& map) {
    map.add(std::make_shared<const StretchBound>(jacobian_net(map.space(), map.rest()), bound));
  };
  const ParametrizationResult result = parametrize(mesh, options);
  // 3. Print the energy and the distance to the bound.
  const Verdict& verdict = result.checks.front().verdict;
  std::cout << status_name(result.status) << ", energy " << result.measures.value << " instead of "
            << free.measures.value << ", stretch " << bound - verdict.margin << " instead of "
            << stretch << "\n";
  write_vtu(argv[2], to_map_file(*result.map));
  return result.status == Status::Converged && verdict.feasible ? 0 : 1;
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
