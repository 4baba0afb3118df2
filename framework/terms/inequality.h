// Inequalities g(z) >= 0 of the unknowns of a few nodes, as terms: a barrier that ends at the
// constrained optimum, or a penalty.
//
//   Cells pairs(1, 2);
//   pairs << 0, 1;
//   auto apart = inequality<2, 2>("apart", pairs, [](Index, const auto& z) {
//     return (z.col(1) - z.col(0)).squaredNorm() - 0.25;
//   });
//   const TermId wall = builder.add(apart.barrier(), 1.0);      // for BarrierMinimizer({wall})
//   builder.add(apart.checker());     // starts may be outside: BarrierMinimizer::of_bounds(), and
//                                     // parametrize() (MapExtension::add())
//   builder.add(apart.penalty(), 1e3);                          // any minimizer
//
// The barrier -log g keeps every accepted point inside, from a start that is inside. The way
// between points is not tested, so a long step may jump over a gap between two feasible parts. By
// itself the barrier moves the minimum away from g = 0; BarrierMinimizer
// (framework/barrier_minimizer.h) lowers its weight to 0. The penalty min(g, 0)^2 starts anywhere
// and ends outside by about |multiplier| / (2 weight). Scale g to size about 1.
//
// Not for g = 0: make_least_squares() is its penalty. Not for a bound on a single unknown: Bounds
// is exact and faster.
//
// The lambda is as in local_term.h: with the number of its element, or without it for eight
// elements at a time.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "majorant/framework/feasibility.h"
#include "majorant/framework/terms/local_term.h"

namespace majorant {

namespace detail {

// Returns max(0, missing)^2.
template <class T>
T square_of_missing(T missing) {
  missing = select(missing <= 0.0, T(0.0), missing);
  return missing * missing;
}

// Returns a term with the value f(g, slack) on each element.
template <int N, int Block, class G, class F>
std::shared_ptr<const EnergyTerm> term_of_room(const std::string& name, const Cells& nodes,
                                               const G& g, const Vec& slack, const F& f) {
  if constexpr (takes_unknowns_alone<N, Block, G>) {
    const RowMatrix rows = slack;
    return make_term<N, Block>(
        name, nodes, [g, f](const auto& z, const auto& row) { return f(g(z) + row[0]); }, rows);
  } else {
    return make_term<N, Block>(
        name, nodes, [g, f, slack](Index e, const auto& z) { return f(g(e, z) + slack[e]); });
  }
}

// Holds g(z) > -slack with a slack for each element; paths are not certified.
template <int N, int Block, class F>
class InequalityChecker final : public BarrierChecker, public ViolationMeasure {
 public:
  InequalityChecker(std::string name, Cells nodes, F g)
      : InequalityChecker(std::move(name), nodes, std::move(g), Vec::Zero(nodes.rows())) {}
  InequalityChecker(std::string name, Cells nodes, F g, Vec slack)
      : name_(std::move(name)),
        nodes_(std::move(nodes)),
        g_(std::move(g)),
        slack_(std::move(slack)) {}
  std::string_view name() const override { return name_; }
  Verdict check(VecIn x) const override {
    Verdict verdict;
    verdict.margin = std::numeric_limits<double>::infinity();
    for (Index e = 0; e < nodes_.rows(); ++e) {
      const double room = value(e, x) + slack_[e];
      if (!(room > 0)) verdict.blocking.push_back(e);
      verdict.margin = std::min(verdict.margin, room);
    }
    verdict.feasible = verdict.blocking.empty();
    return verdict;
  }
  StepBound max_step(VecIn, VecIn, double s) const override { return {s, {}}; }
  std::shared_ptr<const EnergyTerm> barrier() const override {
    return term_of_room<N, Block>(name_, nodes_, g_, slack_, [](const auto& room) {
      using std::log;
      return -log(room);
    });
  }
  std::shared_ptr<const EnergyTerm> violation(double margin) const override {
    return term_of_room<N, Block>(name_, nodes_, g_, slack_, [margin](const auto& room) {
      return square_of_missing(margin - room);
    });
  }
  // Returns the checker with the same slack for elements that hold. The slack of others is twice
  // the violation of x, and a small number if that is 0, since g may be small.
  std::shared_ptr<const BarrierChecker> relaxed(VecIn x) const override {
    constexpr double kLeastRoom = 1e-3;
    Vec slack = slack_;
    for (Index e = 0; e < nodes_.rows(); ++e)
      if (const double violated = -value(e, x); !(slack[e] > violated))
        slack[e] = violated + std::max(violated, kLeastRoom);
    return std::make_shared<const InequalityChecker>(name_, nodes_, g_, std::move(slack));
  }

 private:
  double value(Index e, VecIn x) const {
    NodeValues<double, Block, N> z;
    for (int k = 0; k < N; ++k) z.col(k) = x.template segment<Block>(Block * nodes_(e, k));
    if constexpr (takes_unknowns_alone<N, Block, F>)
      return g_(z);
    else
      return g_(e, z);
  }

  std::string name_;
  Cells nodes_;
  F g_;
  Vec slack_;  // of each element
};

}  // namespace detail

template <int N, int Block, class F>
class Inequality {
 public:
  Inequality(std::string name, Cells nodes, F g)
      : name_(std::move(name)), nodes_(std::move(nodes)), g_(std::move(g)) {}

  // Returns the barrier -log g, one element each; +inf where g <= 0.
  std::shared_ptr<const EnergyTerm> barrier() const { return checker()->barrier(); }
  // Returns the checker of g > 0, with that barrier.
  std::shared_ptr<const BarrierChecker> checker() const {
    return std::make_shared<const detail::InequalityChecker<N, Block, F>>(name_, nodes_, g_);
  }
  // Returns the penalty min(g, 0)^2.
  std::shared_ptr<const EnergyTerm> penalty() const {
    return detail::term_of_room<N, Block>(
        name_, nodes_, g_, Vec::Zero(nodes_.rows()),
        [](const auto& g) { return detail::square_of_missing(-g); });
  }

 private:
  std::string name_;
  Cells nodes_;
  F g_;
};

// nodes: #E by N; with Block 1 these are the unknowns themselves.
template <int N, int Block = 1, class F>
Inequality<N, Block, F> inequality(std::string name, Cells nodes, F g) {
  if constexpr (!detail::takes_unknowns_alone<N, Block, F>)
    detail::require_function_of_elements<N, Block, F>();
  return {std::move(name), std::move(nodes), std::move(g)};
}

// Bounds lower <= x <= upper on single unknowns: a barrier, and a checker that limits steps.
//
//   const double none = std::numeric_limits<double>::infinity();
//   Vec lower = Vec::Zero(60), upper = Vec::Constant(60, none);
//   const Bounds bounds(lower, upper);
//   const TermId barrier = builder.add(bounds.barrier(), 1.0);
//   builder.add(bounds.checker());
//   problem = builder.build();
//   y0 = problem.reduce(bounds.interior(x));
//   SolveResult result = BarrierMinimizer({barrier}).minimize(problem, y0, {});
//
// Every accepted point is inside. If the minimum lies at the bounds, BarrierMinimizer
// (framework/barrier_minimizer.h) ends there, to its tolerance. parametrize() also takes checker()
// (MapExtension::add()), and leads a start that violates the bounds inside. Not for fixed unknowns,
// which are eliminated (constraints/constraints.h).

class Bounds {
 public:
  // lower, upper: the bounds of the full unknowns, -inf or +inf for none. Throws Error unless lower
  // < upper and both have the same size.
  Bounds(Vec lower, Vec upper);

  const Vec& lower() const { return lower_; }
  const Vec& upper() const { return upper_; }

  // Returns the barrier -log(x - lower), -log(upper - x), one element for each finite bound. It
  // supports every curvature: all are the exact one, which is positive.
  std::shared_ptr<const EnergyTerm> barrier() const;
  // Returns a checker that accepts points strictly inside. Blocking "elements" are unknowns. Steps
  // are limited exactly, but for rounding. Its members throw InvalidArgument for another number of
  // unknowns.
  std::shared_ptr<const BarrierChecker> checker() const;
  // Returns x, moved inside where it is not: at least `margin` away from a single bound, or that
  // part of the gap between two bounds. 0 < margin <= 1/2.
  Vec interior(Vec x, double margin = 0.1) const;

 private:
  Vec lower_, upper_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
