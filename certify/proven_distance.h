// A proven lower bound on the distance of charts in the plane, rounding included.
//
//   const Packing packing = pack({map, map});
//   const double apart = proven_distance(packing.charts, 4.0 / 1024 * packing.side);
//   if (apart < 4.0 / 1024 * packing.side) say("only {}\n", apart);
//
// The images of two charts are as far apart as their boundaries, unless one lies inside of the
// other. A boundary curve is closer to its chord than the farthest of its control points; chords
// are compared in double with their rounding bounded, curves cut until that says enough. Charts
// inside of others are found by winding numbers; in a hole of another a chart is outside of it.
#pragma once

#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/maps/bezier_map.h"

namespace majorant {

// A lower bound of the distance of any two charts, not more than `at_least` (>= 0; where charts are
// farther apart nothing is looked at); within a part in a thousand of the distance or of
// `at_least`, unless rounding hides it: 0 where charts overlap, touch, or cannot be told apart.
// charts: det J > 0 is assumed. fixed: flags; pairs of two fixed charts are left out (empty: none).
// O(#boundary edges log #boundary edges) for layouts. Throws Stopped.
double proven_distance(const std::vector<BezierMap>& charts, double at_least,
                       const std::vector<char>& fixed = {}, const StopCheck& stop = {});

// The parts of one border that a clearance is between: two points whose way along the border is
// more than `way` times as long as they are apart, or that are on different loops.
struct ClearanceOptions {
  double at_least = 0;  // what is farther apart is not looked at
  double way = 10;
};
// The least distance of such parts of a chart's own border across the plane outside of the chart,
// not more than `at_least`: how wide its narrowest slit is. 0 where parts touch. Approximate: by
// distances of doubles, of curves by those of polygons that follow them. map: injective, or nearly:
// nothing is said of overlaps. O(#boundary edges log #boundary edges) for charts whose border is
// mostly apart. Throws Stopped.
double border_clearance(const BezierMap& map, const ClearanceOptions& options,
                        const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
