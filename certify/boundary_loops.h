// The boundary of a map in the plane: loops of Bezier curves, each with its chart. The proof of
// global_injectivity.h (check_layout) needs nothing else of a map.
//
//   const BoundaryLoops boundary = boundary_loops(map);    // of a map in memory
//
//   BoundaryLoops atlas{.charts = 2};                      // of anything else, say a file
//   std::vector<PlanarCurve> curves;                       // of chart 0, and
//   std::vector<Index> half_edges;                         // whose they are
//   atlas.add_loop(0, curves, half_edges);
#pragma once

#include <vector>

#include "majorant/certify/internal/planar_curve.h"
#include "majorant/maps/bezier_map.h"

namespace majorant {

struct BoundaryLoop {
  Index first, last;  // curves [first, last), in order, the surface on their left
  Index chart;
};

struct BoundaryLoops {
  std::vector<PlanarCurve> curves = {};  // of any degrees
  std::vector<Index> half_edge = {};  // of each curve, as 3 * face + corner, numbered by the caller
  std::vector<BoundaryLoop> loops = {};  // all curves, each once, in order
  Index charts = 0;  // connected components of the surface, closed ones included

  // Appends a loop of curves, each of which ends exactly where the next begins.
  void add_loop(Index chart, const std::vector<PlanarCurve>& loop,
                const std::vector<Index>& half_edges);
  // Returns why these loops bound nothing: a loop with a gap or of fewer than three curves, numbers
  // or labels out of range. Empty if they are valid.
  std::string defect() const;
  // Returns the curve that starts where curve k ends.
  std::vector<Index> next() const;
};

// Returns the loops of the map's mesh, including both sides of its seams. The components of the
// mesh are the charts.
BoundaryLoops boundary_loops(const BezierMap& map);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
