// Points and derivatives of a map's cells at every pixel, by the formulas of the page's shader.
#pragma once

#include <array>
#include <vector>

#include "majorant/maps/distortion.h"
#include "majorant/maps/map_file.h"

namespace majorant {

class BezierImage {
 public:
  // The map must outlive this. scale: the factor of uv in comparisons with the surface.
  BezierImage(const MapFile& map, double scale);

  struct Point {
    Vector2 uv;
    PointDistortion distortion;
    double determinant;  // of the derivatives of uv along the cell's edges from corner 2
  };
  // Evaluates at xi on a cell. Distortion is NaN if the cell's surface triangle has no area.
  Point at(Index cell, const Barycentric& xi) const;
  Vector2 uv(Index cell, const Barycentric& xi) const;

 private:
  // Returns the last triangle of de Casteljau's algorithm.
  std::array<Vector2, 3> last_triangle(Index cell, const Barycentric& xi) const;

  const MapFile& map_;
  double scale_;
  std::vector<int> place_;  // place of a local control point in the array of last_triangle()
  std::vector<Eigen::Matrix2d>
      rest_;  // inverse of the edges p0 - p2, p1 - p2 in a frame of the cell
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
