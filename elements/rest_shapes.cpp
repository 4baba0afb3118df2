#include "majorant/elements/rest_shapes.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>
#include <string>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/rounding.h"

namespace majorant {
namespace {

// Cells that a task measures, some 0.5 ms.
constexpr Index kCellsOfATask = 2048;

// Computes the inverse of the coordinates of tangents T (d by D) in an orthonormal frame, and
// returns their determinant.
double invert(const Eigen::MatrixXd& tangents, Eigen::Ref<RowMatrix> inverse) {
  const Eigen::Index dim = tangents.cols();
  if (tangents.rows() == dim) {
    inverse = tangents.inverse();
    return tangents.determinant();
  }
  // Gram-Schmidt: T = Q R with a positive diagonal of R.
  Eigen::MatrixXd q = tangents, r = Eigen::MatrixXd::Zero(dim, dim);
  double det = 1;
  for (Eigen::Index k = 0; k < dim; ++k) {
    for (Eigen::Index j = 0; j < k; ++j) {
      r(j, k) = q.col(j).dot(tangents.col(k));
      q.col(k) -= q.col(j).dot(q.col(k)) * q.col(j);
    }
    r(k, k) = q.col(k).norm();
    q.col(k) /= r(k, k);
    det *= r(k, k);
  }
  inverse = r.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(dim, dim));
  return det;
}

// Returns orthonormal, positively oriented columns, the first of which is `axis`.
RowMatrix frame_along(const Eigen::VectorXd& axis) {
  const auto dim = axis.size();
  RowMatrix frame(dim, dim);
  frame.col(0) = axis;
  if (dim == 2) frame.col(1) << -axis[1], axis[0];
  if (dim == 3) {
    frame.col(1) = Vector3(axis).unitOrthogonal();
    frame.col(2) = Vector3(axis).cross(Vector3(frame.col(1)));
  }
  return frame;
}

}  // namespace

std::optional<Eigen::RowVector2d> tangent_part(const Points3& positions, const Cells& faces,
                                               Index face, const Vector3& vector) {
  const Vector3 origin = positions.row(faces(face, 2));
  const Vector3 e0 = Vector3(positions.row(faces(face, 0))) - origin;
  const Vector3 e1 = Vector3(positions.row(faces(face, 1))) - origin;
  const Vector3 x = e0.stableNormalized(), y = (e1 - x.dot(e1) * x).stableNormalized();
  const Eigen::RowVector2d part(x.dot(vector), y.dot(vector));
  // A smaller tangent part of a normal vector may be rounding.
  const double least = 32 * kUnitRoundoff<double> * vector.stableNorm();
  if (!part.allFinite() || !(part.stableNorm() > least) || y.isZero()) return std::nullopt;
  return part;
}

RestShapes flat_simplices(const RowMatrix& positions, const Cells& cells) {
  RestShapes rest;
  rest.dim = static_cast<int>(cells.cols()) - 1;
  if (rest.dim < 1 || positions.cols() < rest.dim)
    throw InvalidArgument(
        fmt::format("flat_simplices: positions of {} coordinates for cells of {} "
                    "corners, too few",
                    positions.cols(), cells.cols()));
  require_finite_rows("flat_simplices: positions", positions);
  for (Index e = 0; e < cells.rows(); ++e)
    for (const Index v : cells.row(e))
      if (v < 0 || v >= positions.rows())
        throw InvalidArgument(fmt::format("flat_simplices: cell {} has vertex {}, there are {}", e,
                                          v, positions.rows()));
  double factorial = 1;
  for (int k = 2; k <= rest.dim; ++k) factorial *= k;
  rest.inverse.resize(cells.rows(), rest.dim * rest.dim);
  rest.measure.resize(cells.rows());
  const int origin = rest.dim == 2 ? 2 : 0;  // whichever gives positive cells positive measures
  parallel_for(static_cast<Index>(cells.rows()), kCellsOfATask, [&](Index e) {
    Eigen::MatrixXd tangents(positions.cols(), rest.dim);
    for (int k = 0; k < rest.dim; ++k)
      tangents.col(k) =
          (positions.row(cells(e, origin == 0 ? k + 1 : k)) - positions.row(cells(e, origin)))
              .transpose();
    RowMatrix inverse(rest.dim, rest.dim);
    rest.measure[e] = invert(tangents, inverse) / factorial;
    rest.inverse.row(e) = Eigen::Map<const Eigen::RowVectorXd>(inverse.data(), inverse.size());
  });
  return rest;
}

RestShapes flat_triangles(const Points3& positions, const Cells& faces) {
  return flat_simplices(positions, faces);
}

RowMatrix in_frames(const Points3& positions, const Cells& faces, const Points3& vectors) {
  if (faces.cols() != 3 || vectors.rows() != faces.rows())
    throw InvalidArgument("in_frames: " + std::to_string(vectors.rows()) + " vectors for " +
                          std::to_string(faces.rows()) + " triangles");
  RowMatrix out(faces.rows(), 2);
  for (Index f = 0; f < faces.rows(); ++f) {
    const auto part = tangent_part(positions, faces, f, vectors.row(f));
    if (!vectors.row(f).allFinite())
      throw InvalidArgument("in_frames: the vector of triangle " + std::to_string(f) +
                            " is not finite");
    if (!part)
      throw InvalidArgument("in_frames: the vector of triangle " + std::to_string(f) +
                            " has no tangent part, or the triangle has no plane");
    out.row(f) = *part;
  }
  return out;
}

RestShapes turned(RestShapes rest, const RowMatrix& first_axes) {
  if (rest.curved()) throw InvalidArgument("turned: rest shapes are curved");
  if (first_axes.rows() != rest.inverse.rows() || first_axes.cols() != rest.dim)
    throw InvalidArgument("turned: " + std::to_string(first_axes.rows()) + " axes of " +
                          std::to_string(first_axes.cols()) + " numbers for " +
                          std::to_string(rest.inverse.rows()) + " elements of dimension " +
                          std::to_string(rest.dim));
  for (Index e = 0; e < first_axes.rows(); ++e) {
    const double length = first_axes.row(e).stableNorm();
    if (!(length > 0) || !std::isfinite(length))
      throw InvalidArgument("turned: the axis of element " + std::to_string(e) +
                            " is zero or not finite");
    const RowMatrix inverse = rest.inverse_of(e) * frame_along(first_axes.row(e) / length);
    rest.inverse.row(e) = Eigen::Map<const Eigen::RowVectorXd>(inverse.data(), inverse.size());
  }
  return rest;
}

RowMatrix tabulate_rest(const RestShapes& rest, const ElementSpace& space,
                        const ContractionTable& table, Index e) {
  require_index("tabulate_rest: element", e, space.element_count());
  if (rest.nodes.rows() != space.node_count() || rest.dim != space.reference_dim())
    throw InvalidArgument(fmt::format("tabulate_rest: rest positions of {} nodes, the space has {}",
                                      rest.nodes.rows(), space.node_count()));
  const Eigen::Index points = table.weights.size(), square = rest.dim * rest.dim;
  RowMatrix out(points, square + 1), inverse(rest.dim, rest.dim);
  for (Eigen::Index l = 0; l < points; ++l) {
    Eigen::MatrixXd tangents = Eigen::MatrixXd::Zero(rest.nodes.cols(), rest.dim);
    for (const GradientEntry& g : table.gradient)
      tangents += g.coefficient * table.shape_gradient(l, g.shape_gradient) *
                  rest.nodes.row(space.cells()(e, g.node)).transpose() *
                  table.directions.row(g.direction);
    out(l, square) = invert(tangents, inverse);
    out.row(l).head(square) = Eigen::Map<const Eigen::RowVectorXd>(inverse.data(), square);
  }
  return out;
}

RestShapes curved_shapes(const ElementSpace& space, const RowMatrix& positions,
                         const Quadrature& rule) {
  if (positions.rows() != space.node_count() || positions.cols() < space.reference_dim())
    throw InvalidArgument(
        fmt::format("curved_shapes: {} positions of {} coordinates, one of at least {} is needed "
                    "for each of {} nodes",
                    positions.rows(), positions.cols(), space.reference_dim(), space.node_count()));
  require_finite_rows("curved_shapes: positions", positions);
  RestShapes rest;
  rest.dim = space.reference_dim();
  rest.nodes = positions;
  rest.measure.resize(space.element_count());
  const ContractionTable table = space.tabulate(rule);
  for (Index e = 0; e < space.element_count(); ++e)
    rest.measure[e] = space.reference_measure() *
                      table.weights.dot(tabulate_rest(rest, space, table, e).rightCols(1).col(0));
  return rest;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
