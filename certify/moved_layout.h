// Turns, moves or scales a layout and proves it again, since rounding can turn over triangles that
// are small beside the layout. Packing, --align, --normalize and the unit square of an atlas all
// use it.
//
//   const Vector2 direction = layout_direction(map);
//   std::optional<PlacedMap> placed = into_unit_square(map, direction, options.map.energy);
//   if (placed) placed->map;            // as certified as the map was
//
// Not for pictures, which make no claims: they apply a LayoutMotion without a proof.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/maps/bezier_map.h"
#include "majorant/maps/measure.h"

namespace majorant {

// A motion uv -> (R uv - origin) / size, where R turns `direction`, of length 1, to (1, 0). R uv is
// computed in extended precision. The result is rounded at the end, or after the turn, the shift
// and the division each, so that the least coordinate, used as origin, becomes exactly 0. Equal
// points stay equal.
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

// Returns whether det J > 0 is proven on every face: by bounds that include rounding
// (LocalInjectivity), or by exact arithmetic.
bool has_positive_determinants(const BezierMap& map, const StopCheck& stop = {});

// Properties that a motion must keep besides det J > 0.
struct LayoutRequirements {
  bool simple_boundaries = false;  // each map is globally injective (global_injectivity.h)
  double distance = 0;           // between any two maps before the motion; relative tolerance 1e-12
  std::vector<char> fixed = {};  // flags of maps; pairs of fixed maps are not tested
  // A box for each map that must contain its moved control points. Empty: no boxes.
  std::vector<Eigen::AlignedBox2d> boxes = {};
};

struct MovedLayout {
  std::vector<BezierMap> maps;
  LayoutMotion motion;
};

// Moves the maps by the first of these motions for which all properties can be proven. None if
// there is no such motion: some cells are too small for doubles there.
std::optional<MovedLayout> moved_layout(const std::vector<BezierMap>& maps,
                                        const std::vector<LayoutMotion>& attempts,
                                        const LayoutRequirements& requirements = {},
                                        const StopCheck& stop = {});

// Returns motions that may bring a square into the unit square. Its side is given, and its lower
// left corner after a turn along `direction` is `low`. They are: the exact motion; a division by
// the next power of two, which does not round; and, if the square is right of and above (0, 0), a
// motion without a shift.
std::vector<LayoutMotion> unit_square_motions(const Vector2& direction, const Vector2& low,
                                              double side);

// Returns a power of two, by which division does not round: the largest coordinate becomes 1 to 2.
double layout_unit(const std::vector<BezierMap>& maps);

// Returns the direction of the longer side of the smallest bounding rectangle of the control
// points.
Vector2 layout_direction(const BezierMap& map);

struct PlacedMap {
  BezierMap map;  // rounded
  LayoutMotion placement;
  MapMeasures measures;  // of measure_normalized(), in the units before the motion
};

// Turns the map along `direction`. None if that makes a cell degenerate by rounding. stop: shortens
// the measures, see measure_normalized().
std::optional<PlacedMap> turned_along(const BezierMap& map, const Vector2& direction,
                                      const EnergySum& energy, const StopCheck& stop = {});
// Turns the map and moves it into the unit square without changing its aspect ratio. The lower left
// corner goes to the origin, and the larger side becomes 1, or between 1/2 and 1 if rounding
// requires it. None if the map stays locally injective in neither case, because its smallest cells
// are too small for doubles beside its largest.
std::optional<PlacedMap> into_unit_square(const BezierMap& map, const Vector2& direction,
                                          const EnergySum& energy, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
