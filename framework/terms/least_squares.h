// Least squares from one lambda: residuals of the unknowns of a few nodes, with Gauss-Newton
// curvature and, optionally, a robust loss.
//
//   // y = a exp(b t) through samples: unknowns 0 and 1 are a and b
//   const Vec t = Vec::LinSpaced(9, 0, 1), y = Vec::Random(9);
//   const Cells unknowns = Cells::Ones(9, 1) * Eigen::RowVector2i(0, 1);
//   auto fit = make_least_squares<2>("fit", unknowns, [=](Index e, const auto& z) {
//     using std::exp;
//     return z[0] * exp(z[1] * t[e]) - y[e];
//   }, huber_loss(0.1));
//
// The energy of an element is rho(|r|^2) / 2, as in Ceres; without a loss |r|^2 / 2. The lambda
// returns one residual, or several as std::array{...} or as a vector of Eigen of fixed size;
// local_term.h has its other rules. Without the number of its element, it is called for eight
// elements at a time.
//
// Curvature, with J the derivative of r:
//     Exact        rho' (J^T J + sum_i r_i hess r_i) + 2 rho'' (J^T r) (J^T r)^T
//     Projected, Reweighted        rho' J^T J + 2 max(rho'', 0) (J^T r) (J^T r)^T
// The second one is Gauss-Newton; for rho'' < 0 it is that of iteratively reweighted least squares,
// as in Ceres. It needs no eigenvalues. A Newton run blends it with the exact Hessian near the
// minimum and ends quadratically even if residuals are large. Projection weights above 1 count as
// 1, since Gauss-Newton has no negative eigenvalues.
//
// A robust loss limits the cost of an outlier:
//
//   const RobustLoss loss = cauchy_loss(0.1);
//   const auto [rho, slope, bend] = loss(9.0);   // of |r| = 3
//
// A loss is rho(s) with its first and second derivative, where s = |r|^2 is the squared residual of
// one element; rho(s) = s for small s. The energy is rho(|r|^2) / 2. A residual with |r| > `width`,
// in its units, counts as an outlier. The formulas are those of Ceres.
//
// For blocks of different sizes, such as cameras and points, see parameter_blocks.h. For unknowns
// that nothing holds, use damped steps (framework/levenberg_marquardt.h).
//
// Not for energies of maps: densities (energies/make_energy.h) are several times faster.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <type_traits>

#include "majorant/framework/terms/detail/element_term.h"

namespace majorant {

// Returns rho(s), rho'(s), rho''(s); empty: rho(s) = s.
using RobustLoss = std::function<std::array<double, 3>(double s)>;

// All throw Error unless width > 0.
RobustLoss huber_loss(double width);    // linear in |r| beyond the width; convex
RobustLoss soft_l1_loss(double width);  // the same, smooth
RobustLoss cauchy_loss(double width);   // logarithmic; not convex, like the following
RobustLoss arctan_loss(double width);   // bounded
RobustLoss tukey_loss(double width);    // constant beyond the width: outliers have no influence

namespace detail {

template <int N, int Block, class F>
struct Residuals {
  static constexpr int nodes = N, block = Block;
  F f;
  RobustLoss loss;

  static bool supports(Curvature c) {
    return c == Curvature::Exact || c == Curvature::Projected || c == Curvature::Reweighted;
  }
  template <class... Data>
  double value(Index e, const NodeValues<double, Block, N>& z, const Data&... data) const {
    double s = 0;
    for_each(f(e, z, data...), [&s](double r) { s += r * r; });
    return rho(s)[0] / 2;
  }
  template <class Variable, class... Data>
  Variable model(Index e, const NodeValues<Variable, Block, N>& z, BlendedCurvature curvature,
                 const Data&... data) const {
    constexpr std::size_t size = N * Block;
    const double exact = exact_part(curvature);
    Variable sum;  // value |r|^2, gradient J^T r, second derivatives J^T J plus those of Exact
    for_each(f(e, z, data...), [&](const Variable& r) {
      sum.v += r.v * r.v;
      for (std::size_t i = 0; i < size; ++i) sum.d[i] += r.v * r.d[i];
      if constexpr (Variable::order == 2)
        for (std::size_t i = 0, k = 0; i < size; ++i)
          for (std::size_t j = 0; j <= i; ++j, ++k)
            sum.h[k] += r.d[i] * r.d[j] + exact * r.v * r.h[k];
    });
    const auto [rho0, rho1, rho2] = rho(sum.v);
    if constexpr (Variable::order == 2) {
      const double bend = 2 * (rho2 < 0 ? exact * rho2 : rho2);
      for (std::size_t i = 0, k = 0; i < size; ++i)
        for (std::size_t j = 0; j <= i; ++j, ++k)
          sum.h[k] = rho1 * sum.h[k] + bend * sum.d[i] * sum.d[j];
    }
    for (double& d : sum.d) d *= rho1;
    sum.v = rho0 / 2;
    return sum;
  }
  template <class Z, class Visit, class... Data>
  void visit_residuals(Index e, const Z& z, const Visit& visit, const Data&... data) const {
    for_each(f(e, z, data...), visit);
  }
  std::array<double, 3> rho(double s) const {
    return loss ? loss(s) : std::array<double, 3>{s, 1, 0};
  }

 protected:
  // Returns the weight of the residuals' second derivatives, and of a loss's negative ones.
  static double exact_part(BlendedCurvature curvature) {
    return curvature.model == Curvature::Reweighted
               ? 0.0
               : std::max(0.0, 1 - curvature.projection_weight);
  }
  // Visits the one residual, or each of several.
  template <class R, class Visit>
  static void for_each(const R& residuals, const Visit& visit) {
    if constexpr (std::is_invocable_v<Visit, const R&>)
      visit(residuals);
    else
      for (std::remove_cv_t<decltype(residuals.size())> i = 0; i < residuals.size(); ++i)
        visit(residuals[i]);
  }
};

// A function f(z, data...) that is called for several elements at a time for Hessians.
template <int N, int Block, bool SharesData, class F>
struct RecordedResiduals : Residuals<N, Block, WithoutElement<F>> {
  using Base = Residuals<N, Block, WithoutElement<F>>;
  static constexpr bool shares_data = SharesData;
  static constexpr PackedProjection projection = nullptr;

  template <class... Data>
  TapeNumber record(BlendedCurvature curvature, const NodeValues<TapeNumber, Block, N>& z,
                    const Data&... data) const {
    const double exact = Base::exact_part(curvature);
    TapeNumber sum;
    Base::for_each(Base::f.f(z, data...), [&](const TapeNumber& r) {
      const TapeNumber part = damped(r, exact);
      sum += part * part;
    });
    if (!Base::loss) return sum * 0.5;
    Lanes value, slope, bend;
    const Lanes squares = sum.values();
    for (int i = 0; i < kLanes; ++i) {
      const auto [rho0, rho1, rho2] = Base::loss(squares[i]);
      value[i] = rho0 / 2;
      slope[i] = rho1 / 2;
      bend[i] = (rho2 < 0 ? exact * rho2 : rho2) / 2;
    }
    return with_derivatives(sum, value, slope, bend);
  }
};

}  // namespace detail

// nodes: #E by N; with Block 1 these are the unknowns themselves. Throws InvalidArgument if `nodes`
// does not have N columns, and for negative nodes.
template <int N, int Block = 1, class F>
std::shared_ptr<const EnergyTerm> make_least_squares(std::string name, Cells nodes, F residuals,
                                                     RobustLoss loss = {}) {
  if constexpr (detail::takes_unknowns_alone<N, Block, F>)
    return detail::element_term(
        std::move(name), std::move(nodes),
        detail::RecordedResiduals<N, Block, true, F>{{{std::move(residuals)}, std::move(loss)}});
  else if constexpr (detail::require_function_of_elements<N, Block, F>())
    return detail::element_term(
        std::move(name), std::move(nodes),
        detail::Residuals<N, Block, F>{std::move(residuals), std::move(loss)});
  else
    return nullptr;
}

// Makes a term whose residuals take data that may change between steps (local_term.h).
template <int N, int Block = 1, class F, class Matrix>
std::shared_ptr<const EnergyTerm> make_least_squares(std::string name, Cells nodes, F residuals,
                                                     const Eigen::MatrixBase<Matrix>& data,
                                                     RobustLoss loss = {}) {
  using Row = detail::ElementNumbers::Row;
  constexpr bool is_shared = Matrix::ColsAtCompileTime == 1;
  if constexpr (detail::takes_unknowns_alone<N, Block, F, Row>)
    return detail::element_term(std::move(name), std::move(nodes),
                                detail::RecordedResiduals<N, Block, is_shared, F>{
                                    {{std::move(residuals)}, std::move(loss)}},
                                data);
  else if constexpr (detail::require_function_of_elements<N, Block, F, Row>())
    return detail::element_term(
        std::move(name), std::move(nodes),
        detail::Residuals<N, Block, F>{std::move(residuals), std::move(loss)}, data);
  else
    return nullptr;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
