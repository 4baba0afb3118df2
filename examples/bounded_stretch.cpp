// A bound that is a constraint: the largest stretch of a map stays below a number, proven on every
// face, and the run converges inside the bound instead of stalling at it.
//
// Sample runs:
//   example_bounded_stretch meshes/cap.obj cap.vtu
//   example_bounded_stretch meshes/creature.obj creature.vtu
#include <iostream>

#include "majorant/elements/jacobian_net.h"
#include "majorant/energies/make_energy.h"
#include "majorant/io/read_mesh.h"
#include "majorant/io/vtu.h"
#include "majorant/parametrization/drive/parametrize.h"

using namespace majorant;

// sigma_max(J) < bound at all Bernstein coefficients of J, and so everywhere: sigma_max is convex.
// For the same reason the way between two maps inside is inside.
class StretchBound final : public BarrierChecker {
 public:
  StretchBound(JacobianNet net, double bound) : net_(std::move(net)), bound_(bound) {}
  std::string_view name() const override { return "largest stretch"; }
  Verdict check(VecIn x) const override {
    Verdict verdict;
    verdict.margin = bound_ - largest_stretch(net_, x).maxCoeff();
    verdict.feasible = verdict.margin > 0;
    return verdict;
  }
  StepBound max_step(VecIn, VecIn, double s) const override { return {s, {}}; }
  // -log det(bound^2 I - J^T J), a mean over the coefficients.
  std::shared_ptr<const EnergyTerm> barrier() const override {
    const auto wall = [b = bound_ * bound_](const auto& J) {
      return -log(b * b - b * J.squaredNorm() + J.determinant() * J.determinant());
    };
    const Traits everywhere{.domain = Domain::Everywhere};
    return make_energy(net_.triangles, net_.rest, density<2, 2>("stretch", wall, everywhere),
                       {lattice_rule(1)});
  }
  std::shared_ptr<const BarrierChecker> relaxed(VecIn x) const override {
    const double stretch = largest_stretch(net_, x).maxCoeff();
    return std::make_shared<const StretchBound>(net_, std::max(bound_, 1.1 * stretch));
  }

 private:
  JacobianNet net_;
  double bound_;
};

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
  // 2. The same, where that exceeds the bound by 20 %.
  const double bound = stretch / 1.2;
  options.extend = [&](MapExtension& map) {
    map.add(std::make_shared<const StretchBound>(jacobian_net(map.space(), map.rest()), bound));
  };
  const ParametrizationResult result = parametrize(mesh, options);
  // 3. What it cost, and by how much it is inside.
  const Verdict& verdict = result.checks.front().verdict;
  std::cout << status_name(result.status) << ", energy " << result.measures.value << " instead of "
            << free.measures.value << ", stretch " << bound - verdict.margin << " instead of "
            << stretch << "\n";
  write_vtu(argv[2], to_map_file(*result.map));
  return result.status == Status::Converged && verdict.feasible ? 0 : 1;
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
