#include "majorant/parametrization/initialization/untangle.h"

#include <utility>

#include "majorant/energies/make_energy.h"
#include "majorant/energies/untangling.h"
#include "majorant/energies/vectorized.h"

namespace majorant {
namespace {

MapSpecification untangling(MapSpecification spec) {
  const UntanglingDensity density(1.0);
  spec.energy = {{energy_factory(density, vectorized(density)), 1.0}};
  spec.face_weight.resize(0);
  spec.boundary_angles = BoundaryAngles::Free;
  return spec;
}

double own_first_eps(const MapSpecification& spec) {
  const bool held = spec.boundary == BoundaryCondition::Fixed || spec.pins.size() >= 2;
  return held ? kFirstEpsHeld : kFirstEps;
}

}  // namespace

UntangleResult untangle(const MapSpecification& spec,
                        const std::shared_ptr<const BezierTriangleSpace>& space, VecIn start,
                        const RunRecord& record, double first_eps) {
  const MapSpecification untangling_spec = untangling(spec);
  const LocalInjectivity injectivity(space, 2 * spec.rest->measure);
  const MapProblem map =
      map_problem(untangling_spec, space, start,
                  energy_terms(untangling_spec, space, {lattice_rule(1)}), nullptr);
  UntangledPoint point = descend_untangling(
      map.problem, {map.energies.front()}, [&](VecIn x) { return injectivity.check(x); },
      map.problem.reduce(start), {.first_eps = first_eps > 0 ? first_eps : own_first_eps(spec)},
      record.start_stop());
  return {std::move(point.x), std::move(point.verdict.blocking), point.iterations};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
