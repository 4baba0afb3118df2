// Terms and least squares on blocks of unknowns of different sizes, such as a camera (6) and a
// point (3). The lambda takes a vector for each block.
//
//   Cells first(2, 2);                       // the first unknown of each block
//   first << 0, 12, 6, 12;                   // cameras 0 and 1, both with point 0
//   auto seen = make_least_squares("seen", ParameterBlocks<6, 3>(first),
//     [](Index, const auto& camera, const auto& point) {
//       return (camera.template head<3>() - point).eval();
//     });
//
// The vectors are columns of doubles or dual numbers. Everything else is as in local_term.h and
// least_squares.h: lambdas of the blocks alone are called for eight elements at a time.
//
// Not for blocks of equal size: use nodes (make_least_squares<N, Block>).
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <type_traits>
#include <utility>

#include "majorant/framework/terms/least_squares.h"
#include "majorant/framework/terms/local_term.h"

namespace majorant {

template <int... Sizes>
class ParameterBlocks {
 public:
  static constexpr int count = sizeof...(Sizes), size = (Sizes + ...);

  // first: #E by count. Throws InvalidArgument for another number of columns.
  explicit ParameterBlocks(const Cells& first) : unknowns_(first.rows(), size) {
    if (first.cols() != count)
      throw InvalidArgument("ParameterBlocks: " + std::to_string(count) +
                            " blocks an element, the list has " + std::to_string(first.cols()) +
                            " columns");
    for (Index e = 0; e < first.rows(); ++e)
      for (int k = 0, column = 0; k < count; ++k)
        for (int i = 0; i < kSizes[k]; ++i) unknowns_(e, column++) = first(e, k) + i;
  }

  const Cells& unknowns() const { return unknowns_; }  // #E by size

  // True if the lambda takes the blocks without the number of the element.
  template <class F>
  static constexpr bool takes_blocks_alone =
      std::is_invocable_v<const F&, const Eigen::Matrix<double, Sizes, 1>&...>;
  // Calls f(e, block, ...), or f(block, ...), with the unknowns z of an element.
  template <class F, class Z, class... Element>
  static auto apply(const F& f, const Z& z, Element... e) {
    return apply_to(f, z, std::make_index_sequence<count>(), e...);
  }
  // Returns f as a function of the number of an element and its unknowns, or of the unknowns alone.
  template <class F>
  static auto of_unknowns(F f) {
    if constexpr (takes_blocks_alone<F>)
      return [f = std::move(f)](const auto& z) { return apply(f, z); };
    else
      return [f = std::move(f)](Index e, const auto& z) { return apply(f, z, e); };
  }

 private:
  static constexpr std::array<int, count> kSizes{Sizes...};
  static constexpr int begin(std::size_t k) {
    int sum = 0;
    for (std::size_t i = 0; i < k; ++i) sum += kSizes[i];
    return sum;
  }
  template <class F, class Z, std::size_t... K, class... Element>
  static auto apply_to(const F& f, const Z& z, std::index_sequence<K...>, Element... e) {
    using T = typename Z::Scalar;
    return f(e..., Eigen::Matrix<T, kSizes[K], 1>(
                       z.template segment<kSizes[K]>(begin(K)).transpose())...);
  }

  Cells unknowns_;
};

// Makes the term of f(Index e, block, ...) or f(block, ...) -> T, as make_term() does for nodes.
template <int... Sizes, class F>
std::shared_ptr<const EnergyTerm> make_term(std::string name,
                                            const ParameterBlocks<Sizes...>& blocks, F f) {
  using Blocks = ParameterBlocks<Sizes...>;
  return make_term<Blocks::size>(std::move(name), blocks.unknowns(),
                                 Blocks::of_unknowns(std::move(f)));
}

// Makes the term of residuals(Index e, block, ...) or residuals(block, ...), as
// make_least_squares() does for nodes.
template <int... Sizes, class F>
std::shared_ptr<const EnergyTerm> make_least_squares(std::string name,
                                                     const ParameterBlocks<Sizes...>& blocks,
                                                     F residuals, RobustLoss loss = {}) {
  using Blocks = ParameterBlocks<Sizes...>;
  return make_least_squares<Blocks::size>(std::move(name), blocks.unknowns(),
                                          Blocks::of_unknowns(std::move(residuals)),
                                          std::move(loss));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
