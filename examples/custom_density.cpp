// A density that is not isotropic: any function of the Jacobian J, by its entries in the frame of
// each face (e0 = p0 - p2 along the first axis). Here cloth: stretching across the weft costs more
// than along it, on top of symmetric Dirichlet.
//
// Sample run:
//   example_custom_density meshes/cap.obj cap.vtu
#include <iostream>

#include "majorant/energies/make_energy.h"
#include "majorant/io/read_mesh.h"
#include "majorant/io/vtu.h"
#include "majorant/parametrization/drive/parametrize.h"

using namespace majorant;

int main(int argc, char** argv) {
  if (argc < 3) return std::cerr << "usage: " << argv[0] << " IN.obj OUT.vtu\n", 1;
  auto mesh = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(read_mesh(argv[1])));
  // 1. f(J) of a 2 by 2 J; J(i, j), squaredNorm(), determinant(), inverse(), products...
  auto cloth = density<2, 2>("cloth", [](const auto& J) {
    auto weft = J(0, 1) * J(0, 1) + J(1, 1) * J(1, 1);  // squared stretch of the second axis
    return J.squaredNorm() + J.inverse().squaredNorm() + 2.0 * (weft - 1.0) * (weft - 1.0);
  });
  // 2. Like any other energy. Derivatives are exact, the Hessian is projected by eigenvalues.
  ParametrizationOptions options;
  options.map.degree = 2;
  options.map.energy = {{energy_factory(cloth)}};
  ParametrizationResult result = parametrize(mesh, options);
  write_vtu(argv[2], to_map_file(*result.map));
  std::cout << status_name(result.status) << ", energy " << result.measures.value << "\n";
  return result.status == Status::Converged ? 0 : 1;
}
