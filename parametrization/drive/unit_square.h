// A layout moved into the unit square, aspect ratio kept: before it is certified, since rounding
// can turn triangles over that are small beside the layout.
//
//   std::optional<InUnitSquare> normalized = into_unit_square(map, options.map.energy);
//   if (normalized) normalized->map;            // as certified as the map was
#pragma once

#include <optional>

#include "majorant/parametrization/maps/measure.h"

namespace majorant {

struct InUnitSquare {
  BezierMap map;  // control points (uv - origin) / size, rounded
  Vector2 origin;
  double size = 1;
  MapMeasures measures;  // measure_normalized(): in the units of before
};

// Lower left corner at the origin, the larger side 1; where that rounds a cell away, between 1/2
// and 1 (division by a power of two rounds nothing). None when the map stays locally injective in
// neither: its smallest cells are below what doubles resolve beside its largest.
std::optional<InUnitSquare> into_unit_square(const BezierMap& map, const EnergySum& energy,
                                             const StopCheck& stop = {});

}  // namespace majorant
