// Winding numbers of boundary loops around a point, and the sense in which loops run: exact where
// they say so.
//
//   const BoundaryLoops boundary = boundary_loops(map);
//   const LoopWinding winding(boundary);
//   winding.around({0.5, 0.5}, [](const BoundaryLoop& loop) { return loop.chart == 2; });
//
// Winding numbers are counted: crossings of the ray to the right of the point. Curves that cross it
// are cut until their pieces lie in half-planes without the point, every rounding error bounded;
// lines are decided exactly.
#pragma once

#include <functional>
#include <optional>

#include "majorant/certify/boundary_loops.h"
#include "majorant/mesh/box_tree.h"

namespace majorant {

// Box around the control points.
Box2 box_of(const PlanarCurve& curve);

// 1: a loop that is simple runs counterclockwise, -1: clockwise, 0: it encloses too little to tell
// (never if all its curves are lines).
int sense_of(const BoundaryLoops& boundary, const BoundaryLoop& loop);

class LoopWinding {
 public:
  using Choice = std::function<bool(const BoundaryLoop&)>;

  // Keeps a reference to loops without defect().
  explicit LoopWinding(const BoundaryLoops& boundary);

  // The sum of the winding numbers of the chosen loops around p; none if p may lie on one of them.
  // O(log #curves) and some microseconds for each curve whose box meets the ray.
  std::optional<long> around(const Vector2& p, const Choice& chosen) const;

 private:
  const BoundaryLoops& boundary_;
  std::vector<std::size_t> loop_of_;  // of each curve
  BoxTree<2> tree_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
