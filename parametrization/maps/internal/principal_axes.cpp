#include "majorant/parametrization/maps/internal/principal_axes.h"

#include <cmath>

#include "majorant/framework/internal/symmetric_eigen.h"

namespace majorant {
namespace {

// Of the two moments, from which on a layout has a long side.
// Origin: squares and disks stay as they are, rounding and all; chosen, not tuned.
constexpr double kLeastRatio = 1.02;

// Third moment over the 3/2 power of the second, from which on the two ends differ.
// Origin: rounding of symmetric layouts is far below; chosen, not tuned.
constexpr double kLeastSkewness = 1e-3;

struct Triangle {
  double area;
  Vector2 centre;
  Eigen::Matrix2d spread;  // second moment about the centre, per area
};

Triangle triangle_at(const Points2& uv, const Cells& cells, Index c, const Vector2& origin,
                     double scale) {
  Eigen::Matrix<double, 2, 3> p;
  for (Index k = 0; k < 3; ++k) p.col(k) = (uv.row(cells(c, k)).transpose() - origin) / scale;
  const Vector2 centre = p.rowwise().mean();
  const Eigen::Matrix<double, 2, 3> q = p.colwise() - centre;
  return {0.5 * std::abs(cross(q.col(1) - q.col(0), q.col(2) - q.col(0))), centre,
          q * q.transpose() / 12};
}

}  // namespace

Vector2 principal_direction(const Points2& uv, const Cells& cells) {
  const Vector2 low = uv.colwise().minCoeff(), high = uv.colwise().maxCoeff();
  const double size = (high - low).maxCoeff();
  if (!(size > 0) || !std::isfinite(size)) return {1, 0};
  double area = 0;
  Vector2 first = Vector2::Zero();
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
  for (Index c = 0; c < cells.rows(); ++c) {
    const Triangle t = triangle_at(uv, cells, c, low, size);
    area += t.area;
    first += t.area * t.centre;
    second += t.area * (t.spread + t.centre * t.centre.transpose());
  }
  if (!(area > 0)) return {1, 0};
  const Vector2 mean = first / area;
  const SymmetricEigen axes = symmetric_eigen(second / area - mean * mean.transpose());
  if (!(axes.values[1] > kLeastRatio * axes.values[0])) return {1, 0};
  const Vector2 direction = axes.vectors.col(1);
  double third = 0;
  for (Index c = 0; c < cells.rows(); ++c) {
    const Triangle t = triangle_at(uv, cells, c, low, size);
    third += t.area * std::pow(direction.dot(t.centre - mean), 3);
  }
  const bool is_even = std::abs(third) < kLeastSkewness * area * std::pow(axes.values[1], 1.5);
  const bool turns_back = is_even ? direction.x() < 0 : third < 0;
  return turns_back ? Vector2(-direction) : direction;
}

Points2 turned_along(const Points2& uv, const Vector2& direction) {
  const double c = direction.x(), s = direction.y();
  Points2 turned(uv.rows(), 2);
  for (Index p = 0; p < uv.rows(); ++p)
    turned.row(p) << c * uv(p, 0) + s * uv(p, 1), c * uv(p, 1) - s * uv(p, 0);
  return turned;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
