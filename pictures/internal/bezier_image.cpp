#include "majorant/pictures/internal/bezier_image.h"

#include "majorant/maps/bezier_cell.h"

namespace majorant {
namespace {

// Returns the place of control point (i, j, k) of degree n, row by row of falling i.
int row_place(int n, int i, int j) {
  const int row = n - i;
  return row * (row + 1) / 2 + (n - i - j);
}

Eigen::Matrix2d inverse_edges(const Vector3& e, const Vector3& f) {
  const double length = e.norm(), along = e.dot(f) / length;
  Eigen::Matrix2d edges;
  edges << length, along, 0, e.cross(f).norm() / length;
  return edges.inverse();
}

}  // namespace

BezierImage::BezierImage(const MapFile& map, double scale) : map_(map), scale_(scale) {
  for (const auto& [i, j, k] : bezier_multi_indices(map.degree))
    place_.push_back(row_place(map.degree, i, j));
  const auto corner = [&](Index c, Index k) { return Vector3(map.points.row(map.cells(c, k))); };
  for (Index c = 0; c < map.cells.rows(); ++c)
    rest_.push_back(inverse_edges(corner(c, 0) - corner(c, 2), corner(c, 1) - corner(c, 2)));
}

std::array<Vector2, 3> BezierImage::last_triangle(Index cell, const Barycentric& xi) const {
  thread_local std::vector<Vector2> b;
  b.resize(place_.size());
  for (std::size_t l = 0; l < place_.size(); ++l)
    b[majorant::to_size(place_[l])] = map_.uv.row(map_.cells(cell, static_cast<Index>(l)));
  // Row r holds r + 1 points; a small triangle is a point and the two below it.
  for (int n = map_.degree; n > 1; --n)
    for (int row = 0, first = 0; row < n; first += ++row)
      for (int k = 0; k <= row; ++k) {
        const std::size_t top = majorant::to_size(first + k),
                          below = majorant::to_size(first + row + 1 + k);
        b[top] = xi[0] * b[top] + xi[1] * b[below] + xi[2] * b[below + 1];
      }
  return {b[0], b[1], b[2]};
}

Vector2 BezierImage::uv(Index cell, const Barycentric& xi) const {
  const auto [p, q, r] = last_triangle(cell, xi);
  return xi[0] * p + xi[1] * q + xi[2] * r;
}

BezierImage::Point BezierImage::at(Index cell, const Barycentric& xi) const {
  const auto [p, q, r] = last_triangle(cell, xi);
  Eigen::Matrix2d edges;
  edges.col(0) = p - r;
  edges.col(1) = q - r;
  return {xi[0] * p + xi[1] * q + xi[2] * r,
          distortion_of(scale_ * map_.degree * edges * rest_[majorant::to_size(cell)]),
          edges.determinant()};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
