#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "distributed/internal/angles_of_parts.h"
#include "majorant/constraints/local_injectivity.h"

namespace majorant {
std::string MeshPart::obstacle(const BezierMap& map, const Vec& rest_det, int depth) const {
  Verdict faces;
  if (mesh->face_count() > 0)
    faces = LocalInjectivity(map.shared_space(), rest_det, depth).check(map.control_points());
  const double wrong = ranks().sum(static_cast<double>(faces.blocking.size()));
  if (wrong > 0) return fmt::format("{:.0f} faces are not positively oriented", wrong);
  const AnglesOfParts angles = angles_of_parts(*this, map);
  if (angles.off == 0) return {};
  return fmt::format("it covers the neighbourhoods of {} vertices more than once", angles.off);
}

MapMeasures MeshPart::measure(const BezierMap& map, const EnergySum& energy,
                              std::string& unproven) const {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  MapMeasures m;
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
  ranks().min(extremes);
  ranks().sum(sums);
  m.sigma_min = extremes[0];
  m.sigma_max = -extremes[1];
  m.max_density = -extremes[2];
  m.value = sums[0] / sums[1];
  const AnglesOfParts angles = angles_of_parts(*this, map);
  m.boundary_over_full_turn = angles.over_full_turn;
  m.max_boundary_angle = angles.largest;
  m.locally_injective = extremes[3] > 0 && angles.off == 0;
  if (!m.locally_injective)
    unproven = fmt::format(
        "{:.0f} faces are not proven to be positively oriented, angle sums at {} vertices are not "
        "full turns",
        sums[2], angles.off);
  return m;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
