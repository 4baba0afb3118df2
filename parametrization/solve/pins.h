// Points that are held: pins and handles as they are asked for, checked, and as the solver has
// them.
//
//   const MapOptions asked = with_targets(map, options.map);
//   const bool there = meets_pins(map, asked.pins);   // else pin_homotopy.h leads the map there
#pragma once

#include <functional>
#include <vector>

#include "majorant/constraints/constraints.h"
#include "majorant/maps/bezier_map.h"
#include "majorant/maps/map_options.h"

namespace majorant {

// Returns the options, in which pins and handles without a target get the place that `start` has.
// Throws InvalidArgument for vertices that do not exist.
MapOptions with_targets(const BezierMap& start, MapOptions asked);

// Pins this close to where the start has their vertex are there, up to rounding. Model units;
// start: 2 numbers per vertex.
double pin_tolerance(VecIn start);
// Returns the same for a start in parts, of which this is the largest coordinate.
double pin_tolerance(double largest_coordinate);

// Returns whether all pins are where the start has them. They must have targets and exist.
bool meets_pins(const BezierMap& start, const std::vector<Pin>& pins);

// Throws Error(Unsupported) for a vertex that is pinned twice.
void require_pinned_once(const SurfaceMesh& mesh, const std::vector<Pin>& pins);

// Pins as fixed points: a target must be where the start has the vertex, to `tolerance`, because
// the solver moves along maps that satisfy the constraints. is_held: whether something else already
// says the same of a vertex, up to rounding; it stays to the bit. Throws InvalidArgument for
// vertices that do not exist, Error(Infeasible) for a target elsewhere; as require_pinned_once().
std::vector<FixedPoint> place_pins(const SurfaceMesh& mesh, const std::vector<Pin>& pins,
                                   const Vec& start, double tolerance,
                                   const std::function<bool(Index vertex)>& is_held);

// Soft handles may be anywhere that numbers reach: Error(Unsupported) beyond kLargestFactor sizes,
// and where a vertex has two, or is one of `pins`. scale: to model sizes.
std::vector<FixedPoint> place_handles(const SurfaceMesh& mesh, const std::vector<Pin>& handles,
                                      const std::vector<FixedPoint>& pins, const Vec& start,
                                      double scale);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
