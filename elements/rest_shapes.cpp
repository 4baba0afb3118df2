#include "majorant/elements/rest_shapes.h"

#include <Eigen/Dense>
#include <stdexcept>

namespace majorant {
namespace {

// Tangents T (d by D) -> inverse of their coordinates in an orthonormal frame, and the determinant.
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

}  // namespace

RestShapes flat_simplices(const RowMatrix& positions, const Cells& cells) {
  RestShapes rest;
  rest.dim = static_cast<int>(cells.cols()) - 1;
  if (positions.cols() < rest.dim)
    throw std::invalid_argument("flat_simplices: positions have too few coordinates");
  double factorial = 1;
  for (int k = 2; k <= rest.dim; ++k) factorial *= k;
  rest.inverse.resize(cells.rows(), rest.dim * rest.dim);
  rest.measure.resize(cells.rows());
  RowMatrix inverse(rest.dim, rest.dim);
  const int origin = rest.dim == 2 ? 2 : 0;  // whichever gives positive cells positive measures
  for (Index e = 0; e < cells.rows(); ++e) {
    Eigen::MatrixXd tangents(positions.cols(), rest.dim);
    for (int k = 0; k < rest.dim; ++k)
      tangents.col(k) =
          (positions.row(cells(e, origin == 0 ? k + 1 : k)) - positions.row(cells(e, origin)))
              .transpose();
    rest.measure[e] = invert(tangents, inverse) / factorial;
    rest.inverse.row(e) = Eigen::Map<const Eigen::RowVectorXd>(inverse.data(), inverse.size());
  }
  return rest;
}

RestShapes flat_triangles(const Points3& positions, const Cells& faces) {
  return flat_simplices(positions, faces);
}

RowMatrix tabulate_rest(const RestShapes& rest, const ElementSpace& space,
                        const ContractionTable& table, Index e) {
  const Eigen::Index points = table.weights.size(), square = rest.dim * rest.dim;
  RowMatrix out(points, square + 1), inverse(rest.dim, rest.dim);
  for (Eigen::Index l = 0; l < points; ++l) {
    Eigen::MatrixXd tangents = Eigen::MatrixXd::Zero(rest.nodes.cols(), rest.dim);
    for (const GradientEntry& g : table.gradient)
      tangents += g.coefficient * table.first(l, g.first) *
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
    throw std::invalid_argument("curved_shapes: one position of at least D numbers per node");
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
