// A density that is not isotropic and not the same everywhere: cloth, woven along a direction that
// is given for each face in space, here around the z axis, and stiffer where the surface is high.
// Its angles of warp and weft, and its lengths along the warp, are to stay.
//
// Sample run:
//   example_custom_density examples/meshes/cap.obj cap.vtu
#include <iostream>

#include "majorant/majorant.h"
#include "majorant/maps/rest_shapes_of.h"

using namespace majorant;

int main(int argc, char** argv) {
  if (argc < 3) return std::cerr << "usage: " << argv[0] << " IN.obj OUT.vtu\n", 1;
  auto mesh = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(read_mesh(argv[1])));
  // 1. Choose data of each face: a direction in space, of any length, and a number.
  Points3 warp(mesh->face_count(), 3);
  Vec stiffness(mesh->face_count());
  for (Index f = 0; f < mesh->face_count(); ++f) {
    const Vector3 center = mesh->positions()(mesh->faces().row(f), Eigen::all).colwise().mean();
    warp.row(f) << -center.y() - 0.1, center.x(), 0;
    stiffness[f] = 1 + center.z() * center.z();
  }
  // 2. f(J, number of the face). Column 0 of J is the image of the warp, column 1 of the weft.
  auto cloth = density<2, 2>(
      "cloth",
      [](const auto& J, double k) {
        auto length = J(0, 0) * J(0, 0) + J(1, 0) * J(1, 0);
        auto shear = J(0, 0) * J(0, 1) + J(1, 0) * J(1, 1);
        return k * ((length - 1.0) * (length - 1.0) + shear * shear);
      },
      stiffness);
  // 3. Like any other energy, in frames turned along the warp; symmetric Dirichlet keeps the rest.
  ParametrizationOptions options;
  options.map.degree = 2;
  options.map.energy = {{symmetric_dirichlet(), 0.1},
                        {along(in_frames(*mesh, warp), energy_factory(cloth))}};
  ParametrizationResult result = parametrize(mesh, options);
  write_vtu(argv[2], to_map_file(*result.map));
  std::cout << status_name(result.status) << ", energy " << result.measures.value << "\n";
  return result.status == Status::Converged ? 0 : 1;
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
