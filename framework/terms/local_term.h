// Makes an energy term from one lambda: any function of the unknowns of a few nodes, differentiated
// automatically.
//
//   Cells ends(2, 2);
//   ends << 0, 1, 1, 2;
//   const Vec rest{{1.0, 1.5}};
//   auto springs = make_term<2, 3>("springs", ends, [rest](Index e, const auto& z) {
//     const auto stretch = (z.col(1) - z.col(0)).norm() - rest[e];
//     return stretch * stretch;
//   });
//   builder.add(springs, 10.0);
//
// The lambda gets the element's number, for captured data, and the unknowns z of its nodes: Block
// by N, where column i is the node ends(e, i). Their type is double for the energy, Dual1 for the
// gradient, and Dual2 for the Hessian, so the lambda must be generic. It must also be deterministic
// and safe to call from several threads. `using std::sqrt;` and so on make functions work for all
// types (dual2.h has the list). Branches on values are permitted if the energy stays continuous.
// Eigen evaluates the algebra: expressions that are used twice need .eval(), and data enter as
// doubles.
//
// Some numbers change between steps: the point of a linearization, the last time step, the
// parameter of a homotopy. They are data of the term, which the lambda gets as a third argument:
//
//   const Vec stretched = Vec::Constant(9, 1.5);             // one number an element
//   Cells pairs = Cells::Zero(stretched.size(), 2);
//   pairs.col(1).setOnes();
//   auto term = make_term<2, 3>("springs", pairs, [](Index e, const auto& z, const auto& length) {
//     const auto stretch = (z.col(1) - z.col(0)).norm() - length[e];
//     return stretch * stretch;
//   }, stretched);
//   const TermId id = builder.add(term, 10.0);
//   const Problem now = builder.build().with({{id, {.parameters = 2 * stretched}}});
//
// A vector is passed as a whole; of a matrix every element gets its row, and Problem::with() takes
// the rows one after the other. Pattern and symbolic factor stay valid.
//
// Lambdas that do not need the number of the element leave it out. They are called for eight
// elements at a time for Hessians, which takes a fraction of the time:
//
//   const Cells ends{{0, 1}, {1, 2}};
//   const RowMatrix lengths = RowMatrix::Constant(2, 1, 1.5);   // a row an element
//   auto bars = make_term<2, 3>("bars", ends, [](const auto& z, const auto& length) {
//     const auto stretch = (z.col(1) - z.col(0)).norm() - length[0];
//     return stretch * stretch;
//   }, lengths);
//
// Results do not depend on the elements that are called together. If elements take different
// branches, the lambda is called for each element alone; select(condition, a, b) chooses for each
// element without that. In such lambdas data are numbers of eight elements, too, and not doubles,
// unless a vector is passed as a whole.
//
// NaN and +inf mean that z is outside the domain: line searches stay inside. An exception thrown by
// the lambda ends the solve and reaches the caller of minimize().
//
// If the nodes of an element have different numbers of unknowns, or the element needs single
// unknowns, leave Block out and list unknowns instead of nodes: make_term<5>("hinge", unknowns, f),
// z[0] to z[4].
//
// Curvature: Exact, and Projected by an eigendecomposition of the N Block by N Block matrix. Not
// for energies of maps: make_energy() is several times faster, and integrates. Not for elements of
// more than 30 unknowns: a Hessian costs 3 (N Block)^2 operations for every product in the lambda,
// a gradient 2 N Block.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "majorant/framework/detail/packed_symmetric.h"
#include "majorant/framework/energy_term.h"
#include "majorant/framework/terms/detail/element_term.h"

namespace majorant {

namespace detail {

// Does make_semidefinite() for two nodes. If the energy depends only on their difference, as
// springs do, the blocks of the Hessian are h, -h and h, and the eigenvalues of h suffice.
template <int Block>
void make_pair_semidefinite(double projection_weight, double* k) {
  const auto entry = [k](int i, int j) -> double& { return k[i * (i + 1) / 2 + j]; };
  double largest = 0, off = 0;
  for (int i = 0; i < Block; ++i)
    for (int j = 0; j < Block; ++j) {
      const double h = entry(std::max(i, j), std::min(i, j));
      largest = std::max(largest, std::abs(h));
      off = std::max(off, std::abs(entry(Block + i, j) + h));
      if (j <= i) off = std::max(off, std::abs(entry(Block + i, Block + j) - h));
    }
  if (!(off <= kZeroPivot * largest)) return make_semidefinite<2 * Block>(projection_weight, k);
  make_semidefinite<Block>(projection_weight,
                           k);  // the packed first block comes first
  for (int i = 0; i < Block; ++i)
    for (int j = 0; j < Block; ++j) {
      const double h = entry(std::max(i, j), std::min(i, j));
      entry(Block + i, j) = -h;
      if (j <= i) entry(Block + i, Block + j) = h;
    }
}

template <int N, int Block, class F>
struct LocalFunction {
  static constexpr int nodes = N, block = Block;
  F f;

  static bool supports(Curvature c) { return c == Curvature::Exact || c == Curvature::Projected; }
  template <class... Data>
  double value(Index e, const NodeValues<double, Block, N>& z, const Data&... data) const {
    return f(e, z, data...);
  }
  template <class Variable, class... Data>
  Variable model(Index e, const NodeValues<Variable, Block, N>& z, BlendedCurvature curvature,
                 const Data&... data) const {
    Variable result = f(e, z, data...);
    if constexpr (Variable::order == 2) {
      if (!(curvature.projection_weight > 0)) return result;
      if constexpr (N == 2)
        make_pair_semidefinite<Block>(curvature.projection_weight, result.h.data());
      else
        make_semidefinite<N * Block>(curvature.projection_weight, result.h.data());
    }
    return result;
  }
};

// A function f(z, data...) that is called for several elements at a time for Hessians.
template <int N, int Block, bool SharesData, class F>
struct RecordedFunction {
  static constexpr int nodes = N, block = Block;
  static constexpr bool shares_data = SharesData;
  F f;
  static constexpr PackedProjection projection = [] {
    if constexpr (N == 2)
      return &make_pair_semidefinite<Block>;
    else
      return nullptr;
  }();

  static bool supports(Curvature c) { return c == Curvature::Exact || c == Curvature::Projected; }
  template <class... Data>
  double value(Index, const NodeValues<double, Block, N>& z, const Data&... data) const {
    return f(z, data...);
  }
  template <class Variable, class... Data>
  Variable model(Index, const NodeValues<Variable, Block, N>& z, BlendedCurvature,
                 const Data&... data) const {
    return f(z, data...);
  }
  template <class... Data>
  TapeNumber record(const NodeValues<TapeNumber, Block, N>& z, const Data&... data) const {
    return f(z, data...);
  }
};

}  // namespace detail

// Makes the term of f(Index e, NodeValues<T, Block, N> z) -> T, or f(z). nodes: #E by N; with Block
// 1 these are the unknowns themselves. Throws InvalidArgument if `nodes` does not have N columns,
// and for negative nodes.
template <int N, int Block = 1, class F>
std::shared_ptr<const EnergyTerm> make_term(std::string name, Cells nodes, F f) {
  if constexpr (detail::takes_unknowns_alone<N, Block, F>)
    return detail::element_term(std::move(name), std::move(nodes),
                                detail::RecordedFunction<N, Block, true, F>{std::move(f)});
  else if constexpr (detail::require_function_of_elements<N, Block, F>())
    return detail::element_term(std::move(name), std::move(nodes),
                                detail::LocalFunction<N, Block, F>{std::move(f)});
  else
    return nullptr;
}

// Makes the term of f(Index e, NodeValues<T, Block, N> z, data) -> T, or f(z, data). data: a
// vector, which every element gets, or #E by K, of which element e gets row e. Both arrive as a
// vector, of doubles if a vector is passed as a whole or the lambda takes e. Throws InvalidArgument
// as above, and for data that are empty, not finite or not #E rows.
template <int N, int Block = 1, class F, class Matrix>
std::shared_ptr<const EnergyTerm> make_term(std::string name, Cells nodes, F f,
                                            const Eigen::MatrixBase<Matrix>& data) {
  using Row = detail::ElementNumbers::Row;
  constexpr bool is_shared = Matrix::ColsAtCompileTime == 1;
  if constexpr (detail::takes_unknowns_alone<N, Block, F, Row>)
    return detail::element_term(std::move(name), std::move(nodes),
                                detail::RecordedFunction<N, Block, is_shared, F>{std::move(f)},
                                data);
  else if constexpr (detail::require_function_of_elements<N, Block, F, Row>())
    return detail::element_term(std::move(name), std::move(nodes),
                                detail::LocalFunction<N, Block, F>{std::move(f)}, data);
  else
    return nullptr;
}

// A linear energy c.x: loads, gravity, prices.
//
//   Vec pull = Vec::Zero(3 * 20);
//   pull[3 * 19 + 2] = -9.81;                          // at node 19, against z
//   builder.add(linear_term("weight", -pull), 1.0);    // the energy of a load is -f.x
//
// The energy is unbounded below by itself: other terms or constraints have to hold x.

// coefficients: one for each of the full unknowns; those that are 0 cost nothing. Throws Error if
// one is not finite. Supports every curvature, since its Hessian is 0.
std::shared_ptr<const EnergyTerm> linear_term(std::string name, Vec coefficients);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
