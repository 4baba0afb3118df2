// Checks of pins and handles, and their conversion into points held by the solver.
//
//   const MapOptions placed = with_targets(map, options.map);
//   const bool is_met = meets_pins(map, placed.pins);   // if not, pin_homotopy.h moves the map
#pragma once

#include <functional>
#include <vector>

#include "majorant/constraints/constraints.h"
#include "majorant/maps/bezier_map.h"
#include "majorant/maps/map_options.h"

namespace majorant {

// Returns the options in which pins and handles without a target get the place of the start. Throws
// InvalidArgument for vertices that do not exist.
MapOptions with_targets(const BezierMap& start, MapOptions options);

// Returns the distance at which a pin is met up to rounding, in model units. start: 2 numbers per
// vertex.
double pin_tolerance(VecIn start);
// Returns the same for a start in parts, of which this is the largest coordinate.
double pin_tolerance(double largest_coordinate);

// Returns whether the start meets all pins. They must have targets and exist.
bool meets_pins(const BezierMap& start, const std::vector<Pin>& pins);

// Throws Error(Unsupported) for a vertex that is pinned twice.
void require_pinned_once(const SurfaceMesh& mesh, const std::vector<Pin>& pins);

// Returns the pins as fixed points. A target must be within `tolerance` of where the start has the
// vertex, since the solver moves along maps that satisfy the constraints. is_held: whether another
// constraint already holds the vertex there; its coordinates then stay to the bit. Throws
// InvalidArgument for vertices that do not exist, Error(Infeasible) for a target elsewhere, and the
// errors of require_pinned_once().
std::vector<FixedPoint> place_pins(const SurfaceMesh& mesh, const std::vector<Pin>& pins,
                                   const Vec& start, double tolerance,
                                   const std::function<bool(Index vertex)>& is_held);

// Returns soft handles as points. Throws Error(Unsupported) for targets farther away than
// kLargestFactor sizes, and if a vertex has two handles or is one of `pins`. scale: from model
// sizes.
std::vector<FixedPoint> place_handles(const SurfaceMesh& mesh, const std::vector<Pin>& handles,
                                      const std::vector<FixedPoint>& pins, const Vec& start,
                                      double scale);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
