// Nonlinear equalities g(z) = 0 of the unknowns of a few nodes, held exactly.
//
//   Cells rods(2, 2);
//   rods << 0, 1, 1, 2;
//   builder.add(equality<2, 2>("rods", rods, [](Index, const auto& z) {
//     return (z.col(1) - z.col(0)).squaredNorm() - 1.0;
//   }), 1.0);
//   problem = builder.build();
//   const BarrierResult result = BarrierMinimizer({}).run(problem, y0);
//   const Vec& forces = result.multipliers.front();    // one a rod
//
// The start need not satisfy them. The problem may also have linear constraints, which are
// eliminated, bounds, inequalities (inequality.h) and checkers. Equalities may depend on each
// other; their multipliers are then one choice of many. In any other minimizer, the term by itself
// is the penalty g^2 / 2. Scale g to size about 1, with derivatives that do not vanish where g = 0.
//
// To differentiate the solution by a datum of g (Sensitivity), make the datum an unknown that a
// linear constraint fixes.
//
// Not for linear equalities (constraint.h), nor for conditions that may hold approximately
// (make_least_squares()).
//
// The lambda is as in local_term.h: with the number of its element, or without it for eight
// elements at a time.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "majorant/framework/equality_term.h"
#include "majorant/framework/terms/local_term.h"

namespace majorant {

namespace detail {

// The function l g + r g^2 / 2, with (l, r) the numbers of the element.
template <class F>
struct AugmentedFunction {
  F g;
  template <class Z, class Numbers>
  auto operator()(Index e, const Z& z, const Numbers& numbers) const {
    return augmented(g(e, z), numbers);
  }
  template <class Z, class Numbers>
  auto operator()(const Z& z, const Numbers& numbers) const {
    return augmented(g(z), numbers);
  }

 private:
  template <class Value, class Numbers>
  static auto augmented(const Value& value, const Numbers& numbers) {
    return value * (numbers[0] + 0.5 * numbers[1] * value);
  }
};

template <int N, int Block, class F>
struct EqualityFunction : LocalFunction<N, Block, AugmentedFunction<F>> {
  static constexpr bool is_equality = true;
};
template <int N, int Block, class F>
struct RecordedEquality : RecordedFunction<N, Block, false, AugmentedFunction<F>> {
  static constexpr bool is_equality = true;
};

}  // namespace detail

// nodes: #E by N; with Block 1 these are the unknowns themselves. Add the term with weight 1.
// Throws InvalidArgument if `nodes` does not have N columns, and for negative nodes.
template <int N, int Block = 1, class F>
std::shared_ptr<const EnergyTerm> equality(std::string name, Cells nodes, F g) {
  const RowMatrix penalty = Eigen::RowVector2d(0, 1).replicate(nodes.rows(), 1);
  if constexpr (detail::takes_unknowns_alone<N, Block, F>) {
    return detail::element_term(std::move(name), std::move(nodes),
                                detail::RecordedEquality<N, Block, F>{{{std::move(g)}}}, penalty);
  } else if constexpr (detail::require_function_of_elements<N, Block, F>()) {
    return detail::element_term(std::move(name), std::move(nodes),
                                detail::EqualityFunction<N, Block, F>{{{std::move(g)}}}, penalty);
  } else {
    return nullptr;
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
