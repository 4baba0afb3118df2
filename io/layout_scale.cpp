#include "majorant/io/layout_scale.h"

#include <cmath>

#include "majorant/elements/rest_shapes.h"
#include "majorant/io/claims.h"
#include "majorant/maps/bezier_cell.h"

namespace majorant {
namespace {

double binomial(int n, int k) {
  double b = 1;
  for (int i = 1; i <= k; ++i) b = b * (n - k + i) / i;
  return b;
}

// Returns the integral over [0, 1] of B_i of degree n times B_j of degree n - 1.
double product_integral(int n, int i, int j) {
  return binomial(n, i) * binomial(n - 1, j) / (binomial(2 * n - 1, i + j) * 2 * n);
}

}  // namespace

double layout_scale(const MapFile& file) {
  if (!has_assumed_scale(file)) return claimed_scale(parse_claims(file.claims, ""));
  double layout = 0;
  for (Index c = 0; c < file.cells.rows(); ++c) layout += std::abs(image_area(file, c));
  const double surface = flat_triangles(file.points, file.cells.leftCols<3>()).measure.sum();
  const double scale = std::sqrt(surface / layout);
  return scale > 0 && std::isfinite(scale) ? scale : 1;
}

bool has_assumed_scale(const MapFile& file) { return file.claims.empty(); }

// Uses Green's theorem: half of the integral of c x dc along the boundary, relative to a corner.
double image_area(const MapFile& file, Index c) {
  const int n = file.degree;
  const Vector2 origin = file.uv.row(file.cells(c, 0));
  const auto point = [&](int local) {
    return Vector2(Vector2(file.uv.row(file.cells(c, local))) - origin);
  };
  double twice = 0;
  for (int edge = 0; edge < 3; ++edge) {
    const std::vector<int> along = bezier_edge_points(n, edge);
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j < n; ++j) {
        const Vector2 step = point(along[j + 1]) - point(along[j]);
        twice += product_integral(n, i, j) * n * cross(point(along[i]), step);
      }
  }
  return twice / 2;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
