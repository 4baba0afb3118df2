#include "majorant/parametrization/atlas/unit_square.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "majorant/constraints/local_injectivity.h"
#include "majorant/elements/element_space.h"
#include "majorant/parametrization/injectivity/global_injectivity.h"
#include "majorant/parametrization/maps/rest_shapes_of.h"
#include "majorant/parametrization/packing/proven_distance.h"

namespace majorant {
namespace {

// Of a distance, what division by the size may leave. Origin: some units of rounding.
constexpr double kRounded = 1 - 1e-12;

AtlasSquare common_box(const std::vector<BezierMap>& maps) {
  Vector2 low = Vector2::Constant(INFINITY), high = -low;
  for (const BezierMap& map : maps) {
    const auto points = map.control_points().reshaped(2, map.space().node_count());
    low = low.cwiseMin(points.rowwise().minCoeff());
    high = high.cwiseMax(points.rowwise().maxCoeff());
  }
  return {low, (high - low).maxCoeff()};
}

BezierMap moved(const BezierMap& map, const AtlasSquare& square) {
  Vec x = map.control_points();
  for (Index n = 0; n < map.space().node_count(); ++n)
    x.segment<2>(2 * n) = (x.segment<2>(2 * n) - square.origin) / square.size;
  return map.with(map.shared_space(), std::move(x));
}

bool is_injective(const BezierMap& map) {
  const Vec scale = 2 * rest_shapes(map.mesh()).measure;
  const LocalInjectivity local(map.shared_space(), scale, ProofDepth::kFinal);
  return local.lower_bounds(map.control_points()).minCoeff() > 0 &&
         check_boundary(map).result == Injectivity::Proven;
}

}  // namespace

std::optional<AtlasSquare> into_unit_square(Atlas& atlas, const StopCheck& stop) {
  const std::vector<BezierMap> maps = maps_of(atlas);
  AtlasSquare square = common_box(maps);
  double distance = 0;
  if (atlas.packing) {
    square = {atlas.packing->origin, atlas.packing->side};
    distance = atlas.packing->distance;
  }
  const double power = std::exp2(std::ceil(std::log2(square.size)));
  for (const double size : {square.size, power}) {
    const AtlasSquare attempt{square.origin, size};
    std::vector<BezierMap> out;
    for (const BezierMap& map : maps) {
      stop.poll();
      out.push_back(moved(map, attempt));
      if (!is_injective(out.back())) break;
    }
    if (out.size() < maps.size() || !is_injective(out.back())) continue;
    const double wanted = kRounded * distance / size;
    if (proven_distance(out, wanted, {}, stop) < wanted) continue;
    for (std::size_t k = 0; k < out.size(); ++k) atlas.charts[k].map = std::move(out[k]);
    return attempt;
  }
  return std::nullopt;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
