// A layout turned, moved or scaled, and proven again: rounding can turn triangles over that are
// small beside the layout. The one place where that is decided: packing, --align, --normalize and
// the unit square of an atlas come here.
//
//   const Vector2 direction = layout_direction(map);
//   std::optional<PlacedMap> placed = into_unit_square(map, direction, options.map.energy);
//   if (placed) placed->map;            // as certified as the map was
//
// Not for pictures, which promise nothing: they apply a LayoutMotion and leave it at that.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/maps/bezier_map.h"
#include "majorant/maps/measure.h"

namespace majorant {

// uv of before -> (R uv - origin) / size, where R turns `direction`, of length 1, to (1, 0). R uv
// is computed in extended precision. Rounded at the end, or after the turn, the shift and the
// division each, so that the least coordinate, as origin, becomes 0. Point by point: equal points
// stay equal.
struct LayoutMotion {
  enum class Rounding { AtTheEnd, EachStep };
  Vector2 direction = Vector2(1, 0);
  Vector2 origin = Vector2::Zero();
  double size = 1;
  Rounding rounding = Rounding::AtTheEnd;

  Points2 operator()(const Points2& uv) const;  // #N by 2
  BezierMap operator()(const BezierMap& map) const;
  BezierMesh operator()(BezierMesh mesh) const;
};

// det J > 0 on every face, proven on the digits as they are: by bounds that include rounding
// (LocalInjectivity), in exact arithmetic where these leave a face open.
bool has_positive_determinants(const BezierMap& map, const StopCheck& stop = {});

// Properties that a motion keeps beside det J > 0.
struct LayoutPromise {
  bool simple_boundaries = false;  // each map is injective as a whole (global_injectivity.h)
  double distance = 0;             // of any two maps before; but for a part of 1e-12
  std::vector<char> fixed = {};    // flags of maps; pairs of two of these need not keep it
  // Boxes, one for each map, that hold all its control points once it is moved. Empty: anywhere.
  std::vector<Eigen::AlignedBox2d> boxes = {};
};

struct MovedLayout {
  std::vector<BezierMap> maps;
  LayoutMotion motion;
};

// The maps under the first of these motions for which all of this can be proven; none where there
// is none: the layout has cells that doubles do not resolve there.
std::optional<MovedLayout> moved_layout(const std::vector<BezierMap>& maps,
                                        const std::vector<LayoutMotion>& attempts,
                                        const LayoutPromise& promise = {},
                                        const StopCheck& stop = {});

// Attempts to bring the square of this side whose lower left corner is `low`, once turned along
// `direction`, into the unit square: exactly; divided by the next power of two, which rounds
// nothing; and, where it is right of and above (0, 0), without a shift, which is all that rounds
// then.
std::vector<LayoutMotion> unit_square_motions(const Vector2& direction, const Vector2& low,
                                              double side);

// A power of two, so that dividing by it rounds nothing: the largest coordinate becomes 1 to 2.
double layout_unit(const std::vector<BezierMap>& maps);

// Along the longer side of the smallest rectangle around its control points.
Vector2 layout_direction(const BezierMap& map);

struct PlacedMap {
  BezierMap map;  // rounded
  LayoutMotion placement;
  MapMeasures measures;  // measure_normalized(): in the units of before
};

// Turned along `direction`. None where that rounds a cell away. stop: cuts the measures short, as
// measure_normalized() does.
std::optional<PlacedMap> turned_along(const BezierMap& map, const Vector2& direction,
                                      const EnergySum& energy, const StopCheck& stop = {});
// Turned, then moved into the unit square, aspect ratio kept: lower left corner at the origin, the
// larger side 1; where that rounds a cell away, between 1/2 and 1. None when the map stays locally
// injective in neither: its smallest cells are below what doubles resolve beside its largest.
std::optional<PlacedMap> into_unit_square(const BezierMap& map, const Vector2& direction,
                                          const EnergySum& energy, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
