#include "majorant/energies/detail/dilatation_modes.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "majorant/framework/error.h"

namespace majorant {
namespace {

// A pivot of the Gram matrix below this, relative to its diagonal, counts as 0: the monomials are
// then dependent at the points.
constexpr double kDependent = 1e-10;

// Returns affine coordinates, one a dimension: for a simplex all barycentric ones but the last.
RowMatrix affine_coordinates(const Factors& cell, const RowMatrix& points) {
  Index columns = 0, dim = 0;
  for (const int corners : cell) {
    columns += corners == 2 ? 1 : corners;
    dim += corners - 1;
  }
  if (points.cols() != columns)
    throw InvalidArgument(fmt::format("dilatation_monomials: points of {} coordinates, not {}",
                                      points.cols(), columns));
  RowMatrix out(points.rows(), dim);
  Index from = 0, to = 0;
  for (const int corners : cell) {
    out.middleCols(to, corners - 1) = points.middleCols(from, corners - 1);
    from += corners == 2 ? 1 : corners;
    to += corners - 1;
  }
  return out;
}

}  // namespace

RowMatrix dilatation_monomials(const Factors& cell, const RowMatrix& points, int degree) {
  const RowMatrix x = affine_coordinates(cell, points);
  const Index dim = static_cast<Index>(x.cols());
  const Index linear = degree >= 1 ? dim : 0, quadratic = degree >= 2 ? dim * (dim + 1) / 2 : 0;
  RowMatrix out(x.rows(), 1 + linear + quadratic);
  out.col(0).setOnes();
  out.middleCols(1, linear) = x.leftCols(linear);
  Index column = 1 + linear;
  for (Index i = 0; i < dim && degree >= 2; ++i)
    for (Index j = 0; j <= i; ++j) out.col(column++) = x.col(i).cwiseProduct(x.col(j));
  return out;
}

DilatationModes dilatation_modes(const Quadrature& rule, const Vec& weights, int degree) {
  if (degree < 0 || degree > kMaxDilatationDegree)
    throw InvalidArgument(fmt::format("the dilatation of an element has degree 0 to {}, not {}",
                                      kMaxDilatationDegree, degree));
  const RowMatrix monomials = dilatation_monomials(rule.cell, rule.points, degree);
  const Eigen::MatrixXd gram = monomials.transpose() * weights.asDiagonal() * monomials;
  const Eigen::LLT<Eigen::MatrixXd> factor(gram);
  const Eigen::MatrixXd L = factor.matrixL();
  for (Index k = 0; k < gram.rows(); ++k)
    if (factor.info() != Eigen::Success || !(L(k, k) * L(k, k) > kDependent * gram(k, k)))
      throw InvalidArgument(fmt::format(
          "a rule of {} points is too coarse for a dilatation of degree {}", rule.size(), degree));
  DilatationModes modes;
  modes.transform = L.transpose().triangularView<Eigen::Upper>().solve(
      Eigen::MatrixXd::Identity(gram.rows(), gram.rows()));
  modes.values = monomials * modes.transform;
  return modes;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
