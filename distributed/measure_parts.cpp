#include <array>
#include <limits>

#include "distributed/internal/angles_of_parts.h"
#include "distributed/parametrize_parts.h"
#include "majorant/parametrization/maps/measure.h"

namespace majorant {
PartMeasures measure_parts(const MeshPart& part, const BezierMap& map, const EnergySum& energy) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  PartMeasures m;
  std::array<double, 4> extremes{kNone, kNone, kNone, kNone};  // the least of these
  std::array<double, 3> sums{};
  if (map.mesh().face_count() > 0) {
    MapMeasures here = measure_map(map, energy);
    const double area = map.mesh().area();
    extremes = {here.sigma_min, -here.sigma_max, -here.max_density, here.min_det.minCoeff()};
    sums = {here.value * area, area, static_cast<double>((here.min_det.array() <= 0).count())};
    m.face_value = std::move(here.face_value);
    m.min_det = std::move(here.min_det);
  }
  part.ranks().min(extremes);
  part.ranks().sum(sums);
  m.sigma_min = extremes[0];
  m.sigma_max = -extremes[1];
  m.max_density = -extremes[2];
  m.least_det = extremes[3];
  m.area = sums[1];
  m.value = sums[0] / sums[1];
  m.faces_not_positive = static_cast<Index>(sums[2]);
  const AnglesOfParts angles = angles_of_parts(part, map);
  m.vertices_off = angles.off;
  m.boundary_over_full_turn = angles.over_full_turn;
  m.max_boundary_angle = angles.largest;
  m.locally_injective = m.least_det > 0 && m.vertices_off == 0;
  return m;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
