// A layout put where files want it, along its longer side or into the unit square: before it is
// certified, since rounding can turn triangles over that are small beside the layout.
//
//   const Vector2 direction = layout_direction(map);
//   std::optional<PlacedMap> placed = into_unit_square(map, direction, options.map.energy);
//   if (placed) placed->map;            // as certified as the map was
#pragma once

#include <optional>

#include "majorant/parametrization/maps/bezier_mesh.h"
#include "majorant/parametrization/maps/measure.h"

namespace majorant {

// uv of before -> (R uv - origin) / size, where R turns `direction`, of length 1, to (1, 0).
struct LayoutPlacement {
  Vector2 direction = Vector2(1, 0);
  Vector2 origin = Vector2::Zero();
  double size = 1;

  Points2 operator()(const Points2& uv) const;  // #N by 2
  BezierMesh operator()(BezierMesh mesh) const;
};

struct PlacedMap {
  BezierMap map;  // rounded
  LayoutPlacement placement;
  MapMeasures measures;  // measure_normalized(): in the units of before
};

// layout_direction() of its control points (smallest_rectangle.h).
Vector2 layout_direction(const BezierMap& map);

// Turned along `direction`. None where that rounds a cell away.
std::optional<PlacedMap> turned_along(const BezierMap& map, const Vector2& direction,
                                      const EnergySum& energy, const StopCheck& stop = {});
// Turned, then moved into the unit square, aspect ratio kept: lower left corner at the origin, the
// larger side 1; where that rounds a cell away, between 1/2 and 1 (division by a power of two
// rounds nothing). None when the map stays locally injective in neither: its smallest cells are
// below what doubles resolve beside its largest.
std::optional<PlacedMap> into_unit_square(const BezierMap& map, const Vector2& direction,
                                          const EnergySum& energy, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
