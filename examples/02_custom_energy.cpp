// An energy of one's own, written as a function of the singular values and put into the solver
// without touching the library: here symmetric ARAP, (S - 1)^2 + (s - 1)^2 + (1/S - 1)^2 + (1/s -
// 1)^2.
//
// Sample run:
//   example_02_custom_energy meshes/cap.obj cap.vtu
#include <iostream>

#include "majorant/energies/make_energy.h"
#include "majorant/framework/derivative_check.h"
#include "majorant/io/read_mesh.h"
#include "majorant/io/vtu.h"
#include "majorant/parametrization/parametrize.h"

using namespace majorant;

// 1. The density: one line. Sigma >= |sigma| are the signed singular values of the Jacobian.
auto symmetric_arap() {
  return spectral("symmetric-arap", Domain::PositiveDeterminant, Convexity::Unknown,
                  [](auto S, auto s) {
                    auto p = [](auto x) { return (x - 1.0) * (x - 1.0); };
                    return p(S) + p(s) + p(1.0 / S) + p(1.0 / s);
                  });
}

int main(int, char** argv) {
  auto mesh = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(read_mesh(argv[1])));
  ParametrizationOptions options;
  options.degree = 2;
  // 2. On any element space and quadrature: make_energy does chain rule and assembly.
  options.energy = [](auto space, const RestShapes& rest, const std::vector<Quadrature>& rules) {
    return make_energy(std::move(space), rest, symmetric_arap(), rules);
  };
  ParametrizationResult result = parametrize(mesh, options);
  // 3. Derivatives, checked against finite differences at the result.
  auto space = result.map->shared_space();
  auto rest = flat_triangles(mesh->positions(), mesh->faces());
  auto term = make_energy(space, rest, symmetric_arap(), {lattice_rule(4)});
  auto report = check_derivatives(*term, result.map->control_points(), 1e-4);
  std::cout << name(result.status) << ", energy " << result.measures.value << "\n"
            << report.message();
  write_vtu(argv[2], to_map_file(*result.map));
  return result.status == Status::Converged && report.ok() ? 0 : 1;
}
