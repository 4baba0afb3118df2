#include "majorant/parametrization/atlas/stretch.h"

#include <algorithm>
#include <cmath>

#include "majorant/elements/bernstein.h"
#include "majorant/elements/quadrature.h"
#include "majorant/elements/singular_values.h"
#include "majorant/maps/rest_shapes_of.h"

namespace majorant {
namespace {

// Returns the rule that integrates the stretch: at degree 1 an exact one, else the finest rule of a
// triangle.
Quadrature stretch_rule(int degree) {
  if (degree == 1) return exact_rule({3}, 1);
  return exact_rule({3}, highest_exactness({3}));
}

std::vector<Barycentric> points_on_edges(int degree) {
  if (degree == 1) return {};
  std::vector<Barycentric> points;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 2 * degree; ++i) {
      Barycentric xi = Barycentric::Zero();
      xi[k] = 1 - i / (2.0 * degree);
      xi[(k + 1) % 3] = i / (2.0 * degree);
      points.push_back(xi);
    }
  return points;
}

// Returns the derivatives of the map in face f at a point, by coordinates of the rest shape: 2 by
// 2.
Eigen::Matrix2d jacobian(const BezierMap& map, const RestShapes& rest, Index f,
                         const Eigen::MatrixX2d& gradients) {
  Eigen::Matrix2d j = Eigen::Matrix2d::Zero();
  for (Index q = 0; q < gradients.rows(); ++q)
    j += map.control_points().segment<2>(2 * map.space().cells()(f, q)) * gradients.row(q);
  return j * rest.inverse_of(f);
}

// Returns flags of the faces that have an area; if none has, of all (#F).
std::vector<char> faces_with_area(const SurfaceMesh& mesh) {
  std::vector<char> has_area(to_size(mesh.face_count()), 1);
  for (const RestTriangle& t : mesh.rest_triangles()) has_area[t.face] = 0;
  if (std::find(has_area.begin(), has_area.end(), 1) == has_area.end())
    std::fill(has_area.begin(), has_area.end(), 1);
  return has_area;
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
  const std::vector<char> has_area = faces_with_area(map.mesh());
  const Quadrature rule = stretch_rule(map.degree());
  Stretch s;
  const auto visit = [&](const Barycentric& xi, double weight) {
    const Eigen::MatrixX2d gradients = bernstein_gradients(map.degree(), xi);
    for (Index f = 0; f < map.mesh().face_count(); ++f) {
      if (!has_area[f]) continue;
      const Eigen::Matrix2d j = jacobian(map, rest, f, gradients);
      const double det = j.determinant(), area = rest.measure[f] * weight;
      s.surface_area += area;
      s.image_area += det * area;
      s.square += area * 0.5 * j.squaredNorm() / (det * det);
      s.largest = std::max(s.largest, singular_values(j).first / det);  // 1 / sigma
    }
  };
  for (Index q = 0; q < rule.size(); ++q) visit(rule.points.row(q), rule.weights[q]);
  for (const Barycentric& xi : points_on_edges(map.degree())) visit(xi, 0);
  return normalized(s);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
