// Control points of a triangle whose det J has a minimum that bounds do not resolve and exact
// arithmetic does.
#pragma once

#include "majorant/elements/bernstein.h"

namespace majorant::test {

// Three times (u, v) -> (u, v ((u - m)^2 + e)), of degree 3: det J = 9 ((u - m)^2 + e), least along
// u = m. Control points by blossoming, in VTK's order.
inline Points2 valley(double m, double e) {
  const TriangleIndices& ix = TriangleIndices::of_degree(3);
  Points2 points(ix.count(), 2);
  for (int l = 0; l < ix.count(); ++l) {
    std::vector<Vector2> arguments;
    for (int k = 0; k < 3; ++k)
      for (int c = 0; c < ix.multi(l)[static_cast<std::size_t>(k)]; ++c)
        arguments.emplace_back(k == 1, k == 2);
    double u = 0, v = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      u += arguments[i].x();
      v += arguments[i].y() *
           ((arguments[(i + 1) % 3].x() - m) * (arguments[(i + 2) % 3].x() - m) + e);
    }
    points.row(l) << u, v;
  }
  return points;
}

}  // namespace majorant::test

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
