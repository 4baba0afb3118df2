#include "majorant/parametrization/solve/run_sharing.h"

#include <fmt/format.h>

#include "majorant/maps/measure.h"
#include "majorant/mesh/mesh_messages.h"

namespace majorant {

double RunSharing::mean(const BezierMap& map, const RestShapes& rest,
                        const EnergySum& energy) const {
  Vec unused;
  return mean_density(map, rest, energy, unused);
}

std::string RunSharing::measure(const BezierMap& map, const EnergySum& energy,
                                const StopCheck& stop, MapMeasures& measures) const {
  measures = measure_map(map, energy, stop);
  if (measures.locally_injective) return "";
  const SurfaceMesh& mesh = map.mesh();
  Index face = 0;
  const double least = measures.min_det.minCoeff(&face);
  if (!(least > 0))
    return fmt::format("face {} ({} in all) is not proven to be positively oriented",
                       user_face(mesh, face), (measures.min_det.array() <= 0).count());
  return "angle sums at inner vertices are not full turns";
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
