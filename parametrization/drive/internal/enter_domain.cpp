#include "majorant/parametrization/drive/internal/enter_domain.h"

namespace majorant {

BezierMap enter_domain(const DegreeSolver::Setup& setup, MapDomain& domain, const BezierMap& map,
                       RunRecord& record, std::vector<long>& proven) {
  DegreeSolver::Setup gentle = setup;
  gentle.map.energy = {{symmetric_dirichlet(), 1.0}};
  gentle.solve.curvature = Curvature::Projected;
  const QuadratureLevels levels(
      optimizer_ladder(1, setup.solve.quadrature_points, setup.rules.quadrature),
      map.space().element_count());
  const DensityTerms terms = energy_terms(setup.map, map.shared_space(), levels.rules());
  gentle.asked_energy = [&](VecIn x) {
    return energy_of_map(setup.map, terms, levels.of_faces(), x) + setup.added.energy(x);
  };
  DegreeSolver solver(gentle, domain, map.shared_space(), map.control_points());
  solver.soften_start(record);
  solver.approach(setup.solve.elevation_tolerance, record, Phase::Entry);
  add_counts(proven, solver.proven());
  return map.with(map.shared_space(), solver.x());
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
