#include "majorant/elements/jacobian_net.h"

#include <cmath>

#include "majorant/elements/singular_values.h"
#include "majorant/framework/error.h"
#include "majorant/framework/rounding.h"

namespace majorant {
namespace {

// Returns the corners of control triangles (i, j, l), i + j + l = n - 1, among the nodes of a cell.
Cells corners_of_triangles(const BezierTriangleSpace& space) {
  const int n = space.degree();
  Cells corners(n * (n + 1) / 2, 3);
  Index t = 0;
  for (int i = n - 1; i >= 0; --i)
    for (int j = n - 1 - i; j >= 0; --j, ++t)
      for (int k = 0; k < 3; ++k) {
        Exponents e{i, j, n - 1 - i - j};
        ++e[k];
        corners(t, k) = space.basis().find(e);
      }
  return corners;
}

}  // namespace

Cells control_triangles(const BezierTriangleSpace& space) {
  const Cells corners = corners_of_triangles(space);
  const Index per_face = static_cast<Index>(corners.rows());
  Cells triangles(space.element_count() * per_face, 3);
  for (Index t = 0; t < triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k)
      triangles(t, k) = space.cells()(t / per_face, corners(t % per_face, k));
  return triangles;
}

JacobianNet jacobian_net(const BezierTriangleSpace& space, const RestShapes& rest) {
  const Index faces = space.element_count();
  if (rest.inverse.rows() != faces || rest.measure.size() != faces || rest.dim != 2)
    throw InvalidArgument("jacobian_net: rest shapes are not those of the faces of the space");
  NodeNumbering numbering{control_triangles(space), space.node_count(), {}};
  const Index count = static_cast<Index>(numbering.cells.rows());
  JacobianNet net;
  net.per_face = space.degree() * (space.degree() + 1) / 2;
  net.rest.inverse.resize(count, 4);
  net.rest.measure.resize(count);
  for (Index t = 0; t < count; ++t) {
    const Index f = t / net.per_face;
    net.rest.inverse.row(t) = space.degree() * rest.inverse.row(f);
    net.rest.measure[t] = rest.measure[f] / net.per_face;
  }
  net.triangles = std::make_shared<const BezierTriangleSpace>(std::move(numbering), 1);
  return net;
}

Eigen::Matrix2d jacobian_coefficient(const JacobianNet& net, Index t, VecIn x) {
  const auto point = [&](int k) -> Vector2 {
    return x.segment<2>(2 * net.triangles->cells()(t, k));
  };
  Eigen::Matrix2d edges;
  edges.col(0) = point(0) - point(2);
  edges.col(1) = point(1) - point(2);
  return edges * net.rest.inverse_of(t);
}

Vec largest_stretch(const JacobianNet& net, VecIn x) {
  // Bounds differences, two products, sums and the norms below. The error of each entry of J is at
  // most 4 roundings of |edges| |M|, in the Frobenius norms, and that of the rest 8 of |J|.
  constexpr double kRounding = 2 * kUnitRoundoff<double>;
  Vec stretch(net.triangles->element_count());
  for (Index t = 0; t < stretch.size(); ++t) {
    double edges = 0;
    for (int k = 0; k < 2; ++k)
      edges = std::max(edges, (x.segment<2>(2 * net.triangles->cells()(t, k)) -
                               x.segment<2>(2 * net.triangles->cells()(t, 2)))
                                  .norm());
    const double larger = singular_values(jacobian_coefficient(net, t, x)).first;
    stretch[t] =
        larger * (1 + 8 * kRounding) + 16 * kRounding * edges * net.rest.inverse.row(t).norm();
  }
  return stretch;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
