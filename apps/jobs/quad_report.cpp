#include "majorant/apps/jobs/quad_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>

#include "majorant/quads/quad_measures.h"

namespace majorant {

Json quads_section(const PolygonMesh& quads, const QuadCheck& check, QuadsComparedWith surface,
                   QuadsFeatures features) {
  const bool compared = check.is_surface && surface == QuadsComparedWith::Surface;
  const auto if_surface = [&](auto value) { return check.is_surface ? Json(value) : Json(); };
  const auto if_compared = [&](auto value) { return compared ? Json(value) : Json(); };
  const auto if_features = [&](auto value) {
    return compared && features == QuadsFeatures::Requested ? Json(value) : Json();
  };
  Json section = {{"count", check.count},
                  {"irregular", if_surface(check.irregular)},
                  {"euler_characteristic", if_surface(check.topology.euler_characteristic())},
                  {"components", if_surface(check.topology.components)},
                  {"boundary_loops", if_surface(check.topology.boundary_loops)}};
  for (const QuadMeasure& measure : quad_measures())
    section[Json::json_pointer(std::string(measure.key))] =
        check.is_surface ? Json(measure.value(quads, check)) : Json();
  section.update({{"folded", if_surface(check.folded.size())},
                  {"turned", if_compared(check.turned.size())},
                  {"features",
                   {{"requested", if_features(check.feature_lines)},
                    {"covered", if_features(check.feature_lines - check.uncovered.size())},
                    {"relaxed", Json()}}},
                  {"hausdorff",
                   {{"to_surface", if_compared(check.hausdorff.to_surface)},
                    {"from_surface", if_compared(check.hausdorff.from_surface)}}}});
  return section;
}

std::string describe(const QuadCheck& check, QuadsComparedWith surface) {
  if (!check.is_valid()) return fmt::format("{}", fmt::join(check.defects, "; "));
  const Topology& t = check.topology;
  const std::string measured = fmt::format(
      "{} irregular, scaled Jacobian at least {:.4f}, mean {:.4f}, mean angle deviation {:.2f} "
      "degrees",
      check.irregular, check.min_scaled_jacobian, check.mean_scaled_jacobian,
      check.angle_deviation);
  const std::string counts =
      fmt::format("{} quads, Euler characteristic {}, {} border loop{}", check.count,
                  t.euler_characteristic(), t.boundary_loops, t.boundary_loops == 1 ? "" : "s");
  if (surface == QuadsComparedWith::Nothing)
    return fmt::format("{}, none folded; {}; not compared with a surface", counts, measured);
  const std::string covered =
      check.feature_lines > 0
          ? fmt::format("{} feature line{} covered, ", check.feature_lines - check.uncovered.size(),
                        check.feature_lines == 1 ? "" : "s")
          : "";
  return fmt::format(
      "{} as the surface, {}none folded or turned; {}; {:.3g} to the surface, {:.3g} "
      "from it",
      counts, covered, measured, check.hausdorff.to_surface, check.hausdorff.from_surface);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
