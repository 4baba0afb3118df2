// The texels of a texture, and the parts of them that triangles cover.
//
//   const TexelGrid grid(1024, 512);
//   const Vector2 center = grid.center(3, 4);        // u = 3.5 / 1024, v = 1 - 4.5 / 512
//   const std::array<Vector2, 3> corner{Vector2(0, 0), Vector2(1, 0), Vector2(0, 1)};
//   if (interiors_meet(corner, grid.box(3, 4))) {    // exactly
//     const ClippedTriangle part = clipped(corner, grid.box(3, 4));
//   }
//
// It is decided exactly whether a triangle covers a part of a texel, so that even the thinnest
// charts have texels. The area and centroid of the part are computed in doubles.
#pragma once

#include <array>

#include "majorant/framework/types.h"
#include "majorant/mesh/box_tree.h"

namespace majorant {

class TexelGrid {
 public:
  // The texels of [0, 1]^2; rows from the top, where v = 1. Throws InvalidArgument for sizes below
  // 1.
  TexelGrid(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  Vector2 center(int x, int y) const { return point(x + 0.5, y + 0.5); }
  // Returns the point at numbers of pixels from the left and from the top.
  Vector2 point(double x, double y) const { return {x / width_, 1 - y / height_}; }
  Box2 box(int x, int y) const { return {point(x, y + 1), point(x + 1, y)}; }
  // These return the column and the row of a point; those of the border for points outside.
  int column(double u) const;
  int row(double v) const;

 private:
  int width_, height_;
};

// Returns whether the interiors have a common point; never for triangles without area. Exact.
bool interiors_meet(const std::array<Vector2, 3>& corner, const Box2& box);

// The part of a triangle in a box.
struct ClippedTriangle {
  double area = 0;
  // The centroid of the part in the triangle; >= 0, sum 1. For slivers some point of the part, to
  // rounding.
  Barycentric centroid = Barycentric::Zero();
};
// Requires that the triangle's interior meets the box.
ClippedTriangle clipped(const std::array<Vector2, 3>& corner, const Box2& box);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
