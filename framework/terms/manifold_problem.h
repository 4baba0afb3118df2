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
// Not for linear constraints on unknowns of a manifold, nor for bounds, inequalities, equalities
// and checkers in the same problem: these are refused by name. A manifold without a simple
// retraction can be an equality (equality.h).
#pragma once

#include <memory>
#include <vector>

#include "majorant/framework/newton.h"
#include "majorant/framework/problem.h"
#include "majorant/framework/terms/manifold.h"

namespace majorant {

class ManifoldPoints;
class ManifoldTerm;

// y: coordinates in the chart around x.
struct ManifoldResult : SolveResult {
  Vec x;
};

class ManifoldProblem {
 public:
  Index full_size() const;  // of x
  Index size() const;       // of the coordinates that remain after elimination

  // Returns the same problem in the coordinates of the chart around x, whose points are first moved
  // onto their manifolds; *y, unless null, receives the coordinates of x. For evaluators, factors
  // and check_derivatives(). Throws InvalidArgument for another number of unknowns, and for a point
  // that has no nearest one on its manifold (0 on a sphere).
  Problem around(const Vec& x, Vec* y = nullptr) const;
  // Returns the x of coordinates in the chart around `base`.
  Vec expand(const Vec& base, VecIn y) const;

  // Returns a minimum near x0. The options are those of Newton's method on any problem;
  // saddles_to_leave is ignored. The observer gets x instead of y. Throws as around() does.
  ManifoldResult minimize(const Vec& x0, const NewtonOptions& options = {},
                          RunObserver* observer = nullptr) const;

 private:
  friend class ManifoldProblemBuilder;
  class Descent;
  ManifoldProblem(Problem problem, std::shared_ptr<const ManifoldPoints> points)
      : problem_(std::move(problem)), points_(std::move(points)) {}

  Problem problem_;  // in the chart of any point
  std::shared_ptr<const ManifoldPoints> points_;
};

class ManifoldProblemBuilder {
 public:
  explicit ManifoldProblemBuilder(Index full_size);
  // Puts points on a manifold; each row has the unknowns of one. Throws InvalidArgument for rows of
  // another size than its points, for unknowns that do not exist or are on a manifold already, and
  // after add().
  ManifoldProblemBuilder& on(std::shared_ptr<const Manifold> manifold, const Cells& unknowns);
  // Adds a term or constraint like ProblemBuilder::add(). Throws Error(Unsupported) for a
  // constraint on an unknown of a manifold, naming row and unknown, and for equalities, naming the
  // term.
  TermId add(std::shared_ptr<const EnergyTerm> term, double weight);
  TermId add(std::shared_ptr<const EnergyTerm> term, TermState state);
  ManifoldProblemBuilder& add(const Constraint& constraint);
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
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
