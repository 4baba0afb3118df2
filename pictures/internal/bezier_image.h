// Points and derivatives of the cells of a map, for every pixel: the formulas of the page's shader.
#pragma once

#include <array>
#include <vector>

#include "majorant/maps/distortion.h"
#include "majorant/maps/map_file.h"

namespace majorant {

class BezierImage {
 public:
  // The map must outlive it. scale: what uv is multiplied by before it is compared with the
  // surface.
  BezierImage(const MapFile& map, double scale);

  struct Point {
    Vector2 uv;
    PointDistortion distortion;
    double determinant;  // of the derivatives of uv along the cell's edges from corner 2
  };
  // At xi on a cell. Where the cell's surface triangle has no area: NaN distortion.
  Point at(Index cell, const Barycentric& xi) const;
  Vector2 uv(Index cell, const Barycentric& xi) const;

 private:
  // The triangle that the steps of de Casteljau's algorithm end at.
  std::array<Vector2, 3> last_triangle(Index cell, const Barycentric& xi) const;

  const MapFile& map_;
  double scale_;
  std::vector<int> place_;  // in the triangular array of last_triangle(), of a local control point
  std::vector<Eigen::Matrix2d>
      rest_;  // inverse of the edges p0 - p2, p1 - p2 in a frame of the cell
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
