// Problems some of whose unknowns lie on manifolds: directions, rotations, phases.
//
//   ManifoldProblemBuilder builder(3 * 20);                  // 20 directions
//   Cells unknowns(20, 3);
//   for (Index k = 0; k < 60; ++k) unknowns(k / 3, k % 3) = k;
//   builder.on(unit_sphere(3), unknowns);
//   Cells pairs(19, 2);
//   for (Index k = 0; k < 19; ++k) pairs.row(k) << k, k + 1;
//   builder.add(make_term<2, 3>("bending", pairs, [](Index, const auto& z) {
//     return (z.col(1) - z.col(0)).squaredNorm();
//   }), 1.0);
//   const ManifoldProblem directions = builder.build();
//   const ManifoldResult result = directions.minimize(Vec::Random(60));   // result.x
//
// Terms are made as for any problem and receive the unknowns x, on a manifold or not. Several
// manifolds form a product. Newton's method moves coordinates of the tangent spaces at the current
// points, and its Hessian includes the second derivatives of the retraction. Pattern and symbolic
// factor stay. After each step the points become the bases of the next one ([AMS08] Ch. 6). x is on
// the manifolds to rounding.
//
// Bounds, inequalities, equalities and checkers hold x as in any problem, on manifolds or not:
//
//   ManifoldProblemBuilder builder(6);
//   builder.on(unit_sphere(3), Cells{{0, 1, 2}, {3, 4, 5}});
//   builder.add(linear_term("down", Vec::Ones(6)), 1.0);
//   const auto apart = inequality<2, 3>("apart", Cells{{0, 1}}, [](Index, const auto& z) {
//     return 0.5 - z.col(0).dot(z.col(1));
//   });
//   const auto bound = apart.checker();
//   builder.add(bound);
//   const TermId barrier = builder.add(bound->barrier(), 1.0);
//   const auto method = BarrierMinimizer::of_bounds({{barrier, bound}});
//   const ManifoldBarrierResult result = builder.build().minimize(Vec::Random(6), method);
//
// Not for linear constraints on unknowns of a manifold, which are refused by name: there they are
// equalities. A manifold without a simple retraction is an equality, too (equality.h).
#pragma once

#include <memory>
#include <vector>

#include "majorant/framework/barrier_minimizer.h"
#include "majorant/framework/newton.h"
#include "majorant/framework/problem.h"
#include "majorant/framework/terms/manifold.h"

namespace majorant {

class ManifoldPoints;
class ManifoldTerm;

// y: the coordinates of x on the chart around it.
struct ManifoldResult : SolveResult {
  Vec x;
};
// states: of the problem around x.
struct ManifoldBarrierResult : BarrierResult {
  Vec x;
};

class ManifoldProblem {
 public:
  Index full_size() const;  // of x
  Index size() const;       // of the coordinates that constraints leave: what is solved for
  bool has_checkers() const { return !checkers_.empty(); }

  // Returns the problem without its checkers, in coordinates of the chart around x, whose points
  // are brought onto their manifolds first; *y, unless null, receives the coordinates of x. For
  // evaluators, factors and check_derivatives(). Throws InvalidArgument for another number of
  // unknowns, and where a point has no nearest one on its manifold (0 on a sphere).
  Problem around(const Vec& x, Vec* y = nullptr) const;
  // Returns the x of coordinates in the chart around `base`.
  Vec expand(const Vec& base, VecIn y) const;

  // Returns a minimum near x0. The options are those of Newton's method on any problem;
  // saddles_to_leave is ignored. The observer gets x instead of y. Throws as around() does.
  ManifoldResult minimize(const Vec& x0, const NewtonOptions& options = {},
                          RunObserver* observer = nullptr) const;
  // Returns a minimum under the bounds of the method and the equalities of the problem, like
  // BarrierMinimizer::run(); the start may violate both.
  ManifoldBarrierResult minimize(const Vec& x0, const BarrierMinimizer& method,
                                 RunObserver* observer = nullptr) const;

 private:
  friend class ManifoldProblemBuilder;
  friend class ManifoldSensitivity;
  using Checkers = std::vector<std::shared_ptr<const FeasibilityChecker>>;
  ManifoldProblem(Problem problem, Checkers checkers, std::shared_ptr<const ManifoldPoints> points)
      : problem_(std::move(problem)), checkers_(std::move(checkers)), points_(std::move(points)) {}

  Problem problem_;    // around any point, without checkers
  Checkers checkers_;  // of x
  std::shared_ptr<const ManifoldPoints> points_;
};

class ManifoldProblemBuilder {
 public:
  explicit ManifoldProblemBuilder(Index full_size);
  // Puts points on a manifold; each row has the unknowns of one. Throws InvalidArgument for rows of
  // another size than its points, for unknowns that do not exist or are on a manifold already, and
  // after add().
  ManifoldProblemBuilder& on(std::shared_ptr<const Manifold> manifold, const Cells& unknowns);
  // Adds a term, constraint or checker like ProblemBuilder::add(). Steps along manifolds are
  // certified by checkers at their ends alone. build() throws Error(Unsupported) for a constraint
  // on an unknown of a manifold, with row and unknown.
  TermId add(std::shared_ptr<const EnergyTerm> term, double weight);
  TermId add(std::shared_ptr<const EnergyTerm> term, TermState state);
  ManifoldProblemBuilder& add(const Constraint& constraint);
  ManifoldProblemBuilder& add(std::shared_ptr<const FeasibilityChecker> checker);
  ManifoldProblem build() const;

 private:
  struct Part {
    std::shared_ptr<const EnergyTerm> term;
    TermState state;
  };
  struct Place {
    std::shared_ptr<const Manifold> manifold;
    std::vector<Index> unknowns;
  };
  Index full_size_;
  std::vector<Place> places_;
  std::vector<Part> parts_;
  ConstraintRows rows_;
  ManifoldProblem::Checkers checkers_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
