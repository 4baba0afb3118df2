// A proven lower bound on the distance of charts in the plane, rounding included.
//
//   const Packing packing = pack({map, map});
//   const double apart = proven_distance(packing.charts, 4.0 / 1024 * packing.side);
//   if (apart < 4.0 / 1024 * packing.side) say("only {}\n", apart);
//
// The distance of the images of two charts is that of their boundaries, unless one lies inside of
// the other. A boundary curve is at most as far from its chord as its farthest control point.
// Chords are compared in doubles with bounded rounding, and curves are cut until the bound
// suffices. Charts inside of others are found by winding numbers; a chart in a hole of another is
// outside of it.
#pragma once

#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/maps/bezier_map.h"

namespace majorant {

// Returns a lower bound of the distance of any two charts, at most `at_least` (>= 0); larger
// distances are not examined. It is within a part in a thousand of the distance or of `at_least`,
// unless rounding prevents that. 0 if charts overlap, touch, or may do so. charts: det J > 0 is
// assumed. fixed: flags; pairs of two fixed charts are skipped (empty: none). Takes O(#boundary
// edges log #boundary edges) for layouts. Throws Stopped.
double proven_distance(const std::vector<BezierMap>& charts, double at_least,
                       const std::vector<char>& fixed = {}, const StopCheck& stop = {});

// The pairs of points of one border whose clearance is measured: points on different loops, or
// points whose distance along the border exceeds `way` times their distance in the plane.
struct ClearanceOptions {
  double at_least = 0;  // larger distances are not examined
  double way = 10;
};
// Returns the least distance of such points of a chart's border, across the plane outside of the
// chart, at most `at_least`: the width of its narrowest slit. 0 if they touch. It is approximate:
// curves are replaced by polygons, distances are rounded. map: injective or nearly so; overlaps are
// not detected. Takes O(#boundary edges log #boundary edges) if most of the border is well
// separated. Throws Stopped.
double border_clearance(const BezierMap& map, const ClearanceOptions& options,
                        const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
