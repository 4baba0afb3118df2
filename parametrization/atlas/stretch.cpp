#include <algorithm>
#include <cmath>
#include <vector>

#include "majorant/elements/bernstein.h"
#include "majorant/elements/singular_values.h"
#include "majorant/parametrization/atlas/unwrap.h"
#include "majorant/parametrization/maps/rest_shapes_of.h"

namespace majorant {
namespace {

// Points inside a face, all of the same weight. 10 points a face; for reports alone.
constexpr int kLattice = 6;

std::vector<Barycentric> sample_points(int degree) {
  if (degree == 1) return {Barycentric::Constant(1.0 / 3)};
  std::vector<Barycentric> points;
  for (int i = 1; i < kLattice; ++i)
    for (int j = 1; j < kLattice - i; ++j)
      points.push_back(Barycentric(i, j, kLattice - i - j) / kLattice);
  return points;
}

Stretch normalized(Stretch s) {
  const double scale = s.image_area / s.surface_area;
  s.l2 = std::sqrt(s.square / s.surface_area * scale);
  s.max = s.largest * std::sqrt(scale);
  return s;
}

}  // namespace

Stretch Stretch::joined(const Stretch& other) const {
  Stretch s;
  s.surface_area = surface_area + other.surface_area;
  s.image_area = image_area + other.image_area;
  s.square = square + other.square;
  s.largest = std::max(largest, other.largest);
  return s.surface_area > 0 ? normalized(s) : s;
}

Stretch measure_stretch(const BezierMap& map) {
  const RestShapes rest = rest_shapes(map.mesh());
  Stretch s;
  const std::vector<Barycentric> points = sample_points(map.degree());
  for (const Barycentric& xi : points) {
    const Eigen::MatrixX2d gradients = bernstein_gradients(map.degree(), xi);
    for (Index f = 0; f < map.mesh().face_count(); ++f) {
      Eigen::Matrix2d j = Eigen::Matrix2d::Zero();
      for (Index q = 0; q < gradients.rows(); ++q)
        j += map.control_points().segment<2>(2 * map.space().cells()(f, q)) * gradients.row(q);
      j *= rest.inverse_of(f);
      const double det = j.determinant(), area = rest.measure[f] / double(points.size());
      s.surface_area += area;
      s.image_area += det * area;
      s.square += area * 0.5 * j.squaredNorm() / (det * det);
      s.largest = std::max(s.largest, singular_values(j).first / det);  // 1 / sigma
    }
  }
  return normalized(s);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
