// A cell whose det J has a minimum that bounds do not resolve and exact arithmetic does.
#pragma once

#include <memory>
#include <utility>

#include "majorant/elements/bernstein.h"
#include "majorant/maps/bezier_map.h"

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

// As a map of one face.
inline BezierMap valley_map(double m, double e) {
  PolygonMesh triangle;
  triangle.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  triangle.polygons = {{0, 1, 2}};
  auto mesh = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(triangle));
  auto space = std::make_shared<const BezierTriangleSpace>(mesh->faces(), mesh->vertex_count(), 3);
  const Points2 points = valley(m, e);
  Vec x(2 * space->node_count());
  for (Index k = 0; k < points.rows(); ++k) x.segment<2>(2 * space->cells()(0, k)) = points.row(k);
  return {std::move(mesh), std::move(space), std::move(x)};
}

}  // namespace majorant::test

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
