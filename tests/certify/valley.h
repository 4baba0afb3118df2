// A cell with a minimum of det J that bounds do not resolve, but exact arithmetic does.
#pragma once

#include <memory>
#include <utility>

#include "elements/valley.h"
#include "majorant/elements/bernstein.h"
#include "majorant/maps/bezier_map.h"

namespace majorant::test {

// Returns a map of one face with this valley.
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
