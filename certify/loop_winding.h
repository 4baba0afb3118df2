// Winding numbers of boundary loops around a point, and the senses of loops. Results that are not
// undecided are exact.
//
//   const BoundaryLoops boundary = boundary_loops(map);
//   const LoopWinding winding(boundary);
//   winding.around({0.5, 0.5}, [](const BoundaryLoop& loop) { return loop.chart == 2; });
//
// The winding number counts crossings of the ray to the right of the point. Curves that cross it
// are cut until their pieces lie in half-planes without the point, with all rounding errors
// bounded; lines are decided exactly.
#pragma once

#include <functional>
#include <optional>

#include "majorant/certify/boundary_loops.h"
#include "majorant/mesh/box_tree.h"

namespace majorant {

// Returns the bounding box of the control points.
Box2 box_of(const PlanarCurve& curve);

// Returns 1 if a simple loop is counterclockwise, -1 if it is clockwise, 0 if its area is too small
// to decide (never if all its curves are lines).
int sense_of(const BoundaryLoops& boundary, const BoundaryLoop& loop);

class LoopWinding {
 public:
  using Choice = std::function<bool(const BoundaryLoop&)>;

  // Keeps a reference to loops, which must have no defect().
  explicit LoopWinding(const BoundaryLoops& boundary);

  // Returns the sum of the winding numbers of the chosen loops around p; none if p may lie on one
  // of them. O(log #curves) and some microseconds for each curve whose box meets the ray.
  std::optional<long> around(const Vector2& p, const Choice& chosen) const;

 private:
  const BoundaryLoops& boundary_;
  std::vector<std::size_t> loop_of_;  // of each curve
  BoxTree<2> tree_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
