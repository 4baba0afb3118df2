// Inequalities g(z) >= 0 of the unknowns of a few nodes, as terms: a barrier that ends at the
// constrained optimum, or a penalty.
//
//   Cells pairs(1, 2);
//   pairs << 0, 1;
//   auto apart = inequality<2, 2>("apart", pairs, [](Index, const auto& z) {
//     return (z.col(1) - z.col(0)).squaredNorm() - 0.25;
//   });
//   const TermId wall = builder.add(apart.barrier(), 1.0);      // for BarrierMinimizer({wall})
//   builder.add(apart.penalty(), 1e3);                          // any minimizer
//
// The barrier -log g keeps every accepted point inside, from a start that is inside; which way
// there is not looked at, so a long step may pass over a gap between two feasible parts. By itself
// it moves the minimum away from where g = 0; minimized by BarrierMinimizer
// (framework/barrier_minimizer.h) its weight falls to 0. The penalty min(g, 0)^2 starts anywhere
// and ends outside by about |multiplier| / (2 weight). Scale g to size about 1. For g = 0 rather
// than >= 0, make_least_squares() is the penalty; for a bound on a single unknown bounds.h is exact
// and faster.
//
// The lambda: as in local_term.h.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "majorant/terms/local_term.h"

namespace majorant {

template <int N, int Block, class F>
class Inequality {
 public:
  Inequality(std::string name, Cells nodes, F g)
      : name_(std::move(name)), nodes_(std::move(nodes)), g_(std::move(g)) {}

  // -log g, an element each; +inf where g <= 0.
  std::shared_ptr<const EnergyTerm> barrier() const {
    return make_term<N, Block>(name_, nodes_, [g = g_](Index e, const auto& z) {
      using std::log;
      return -log(g(e, z));
    });
  }
  // min(g, 0)^2.
  std::shared_ptr<const EnergyTerm> penalty() const {
    return make_term<N, Block>(name_, nodes_, [g = g_](Index e, const auto& z) {
      auto violation = g(e, z);
      if (violation >= 0) violation = 0.0;
      return violation * violation;
    });
  }

 private:
  std::string name_;
  Cells nodes_;
  F g_;
};

// nodes: #E by N, or, with Block 1, the unknowns themselves.
template <int N, int Block = 1, class F>
Inequality<N, Block, F> inequality(std::string name, Cells nodes, F g) {
  return {std::move(name), std::move(nodes), std::move(g)};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
