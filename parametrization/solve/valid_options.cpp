#include "majorant/parametrization/solve/valid_options.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "majorant/framework/energy_term.h"
#include "majorant/framework/error.h"

namespace majorant {
namespace {

[[noreturn]] void refuse(const std::string& what) { throw InvalidArgument(what); }

void require_valid(const MapOptions& asked) {
  if (asked.degree < 1 || asked.degree > BezierTriangleSpace::kMaxDegree)
    refuse(fmt::format("degree {} is not one of 1..{}", asked.degree,
                       BezierTriangleSpace::kMaxDegree));
  if (asked.energy.empty()) refuse("no energy is given");
  for (const WeightedEnergy& e : asked.energy)
    if (!is_usable_weight(e.weight))
      refuse(fmt::format("the weight {:g} of an energy is not in {:g}..{:g}", e.weight,
                         1 / kLargestFactor, kLargestFactor));
  if (!is_usable_weight(asked.handle_weight))
    refuse(fmt::format("the weight {:g} of soft handles is not in {:g}..{:g}", asked.handle_weight,
                       1 / kLargestFactor, kLargestFactor));
  for (const auto* points : {&asked.pins, &asked.handles})
    for (const Pin& p : *points)
      if (p.target && !p.target->allFinite())
        refuse(fmt::format("the target of vertex {} is ({:g}, {:g}), finite numbers are needed",
                           p.vertex, p.target->x(), p.target->y()));
}

}  // namespace

void require_valid(const MapOptions& asked, const SolveOptions& how, bool extended) {
  require_valid(asked);
  if (!(how.tolerance > 0) || !std::isfinite(how.tolerance))
    refuse("the tolerance must be a positive number");
  if (!(how.elevation_tolerance >= 0)) refuse("the elevation tolerance must not be negative");
  if (how.injectivity_depth < 0) refuse("the depth of certificates must not be negative");
  if (how.threads < 0) refuse("the number of threads must not be negative");
  if (how.quadrature_points < 0) refuse("the number of quadrature points must not be negative");
  if (asked.injectivity == MapInjectivity::Global &&
      (how.curvature == Curvature::Reweighted || how.curvature == Curvature::CompositeMajorizer))
    refuse(
        fmt::format("the scaffold's energy has no curvature model '{}'; use projected, majorizer "
                    "or exact",
                    curvature_name(how.curvature)));
  if (how.triangles == Triangles::Flipped &&
      (asked.face_weight.size() > 0 || knows_elements(asked.energy)))
    refuse("flipping edges changes the faces that weights and data are for; leave one out");
  if (how.triangles == Triangles::Flipped && extended)
    refuse(
        "flipping edges changes the faces and nodes that were added to; leave one of the two out");
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
