// The factored metric: it equals the shifted Hessian, and refuses other sizes.
#include "majorant/framework/internal/preconditioner.h"

#include <gtest/gtest.h>

#include "framework/barrier_chain.h"
#include "framework/random_matrix.h"
#include "framework/scalar_terms.h"
#include "majorant/framework/error.h"
#include "majorant/framework/internal/symmetric_eigen.h"

namespace majorant {
namespace {

using test::Chain;
using test::QuadraticTerm;
using test::Random;
using test::Rows;

Eigen::MatrixXd dense_hessian(const Problem& problem, VecIn y, Curvature curvature) {
  Vec g, values;
  Evaluator(problem).linearize(y, curvature, g, values);
  const SparsePattern& p = problem.pattern();
  Eigen::MatrixXd m(p.size, p.size);
  m.setZero();
  for (Index c = 0; c < p.size; ++c)
    for (Index k = p.column_starts[static_cast<std::size_t>(c)];
         k < p.column_starts[static_cast<std::size_t>(c) + 1]; ++k) {
      const Index r = p.rows[static_cast<std::size_t>(k)];
      m(r, c) = m(c, r) = values[k];
    }
  return m;
}

TEST(Preconditioner, IsTheHessianAtThePointUnderTheCurvature) {
  const test::ChainProblem chain(20);
  Random random(1);
  const SolverFactory eigen = make_eigen_ldlt_solver, direct = [] { return make_direct_solver(); };
  for (const SolverFactory& make : {eigen, direct}) {
    Preconditioner metric(chain.problem, Curvature::Projected, make());
    for (const double scale : {1.0, 1.5}) {  // refactored at another point
      const Vec y = scale * chain.start;
      ASSERT_TRUE(metric.factorize(y));
      EXPECT_EQ(metric.shift(), 0);
      const Vec r = random.vector(chain.problem.size());
      Vec p;
      metric.solve(r, p);
      EXPECT_LE((dense_hessian(chain.problem, y, Curvature::Projected) * p - r).norm(),
                1e-10 * r.norm());
    }
    EXPECT_EQ(metric.curvature(), Curvature::Projected);
  }
}

TEST(Preconditioner, ShiftsIndefiniteHessiansVisibly) {
  const test::ChainProblem chain(20);
  Preconditioner metric(chain.problem, Curvature::Exact, make_direct_solver());
  ASSERT_TRUE(metric.factorize(chain.start));
  EXPECT_GT(metric.shift(), 0);
  const Eigen::MatrixXd h = dense_hessian(chain.problem, chain.start, Curvature::Exact);
  ASSERT_LT(symmetric_eigen(h).values[0], 0);
  EXPECT_GE(metric.shift(), 1e-3 * h.diagonal().cwiseAbs().mean() * (1 - 1e-12));
  const Vec r = Vec::Ones(h.rows());
  Vec p;
  metric.solve(r, p);
  EXPECT_LE((h * p + metric.shift() * p - r).norm(), 1e-10 * r.norm());
}

// For a semidefinite Hessian the shift is large enough for useful directions, not only for a
// factorization.
TEST(Preconditioner, ShiftsSemidefiniteHessiansByAThousandthOfTheDiagonal) {
  const test::Scalar cubic{[](double t) { return t * t * t / 6; },
                           [](double t) { return t * t / 2; }, [](double t) { return t; }};
  const Problem problem = ProblemBuilder(2).add(std::make_shared<const Chain>(2, cubic), 1).build();
  Preconditioner metric(problem, Curvature::Exact, make_direct_solver());
  ASSERT_TRUE(metric.factorize(Vector2(2, 0)));
  EXPECT_NEAR(metric.shift(), 1e-3, 1e-15);
}

TEST(Preconditioner, NonFiniteHessiansAreNoMetric) {
  const test::Scalar broken{[](double t) { return t; }, [](double) { return 1.0; },
                            [](double) { return std::nan(""); }};
  const Problem problem =
      ProblemBuilder(1).add(std::make_shared<const Chain>(1, broken), 1).build();
  Preconditioner metric(problem, Curvature::Exact, make_direct_solver());
  EXPECT_FALSE(metric.factorize(Vec::Zero(1)));
}

TEST(Preconditioner, UnsupportedCurvatureIsRefused) {
  const test::ChainProblem chain(3);
  EXPECT_THROW(Preconditioner(chain.problem, Curvature::Majorizer, make_direct_solver()),
               InvalidArgument);
}

TEST(Preconditioner, ProblemsMustShareUnknownsAndConstraints) {
  Random random(3);
  const auto term = std::make_shared<const QuadraticTerm>(test::band_elements(6, 2, 1), random);
  const auto build = [&](Index size, const Rows& rows) {
    return ProblemBuilder(size).add(term, 1).add(rows).build();
  };
  Rows pin_first, pin_last, both, other_value, flipped;
  pin_first.row({{0, 1}}, 1);
  pin_last.row({{6, 1}}, 1);
  other_value.row({{0, 1}}, 2);
  both.row({{0, 1}, {6, -1}}, 0);
  flipped.row({{0, 1}, {6, 1}}, 0);
  const Problem a = build(7, pin_first);
  EXPECT_EQ(&preconditioner_problem(a, std::nullopt), &a);
  const std::optional<Problem> same = build(7, other_value);
  EXPECT_EQ(&preconditioner_problem(a, same), &*same) << "right-hand sides do not matter";
  for (const Problem& b : {build(8, pin_first), build(7, {}), build(7, pin_last), build(7, both)})
    EXPECT_THROW(preconditioner_problem(a, b), InvalidArgument);
  EXPECT_THROW(preconditioner_problem(build(7, both), build(7, flipped)), InvalidArgument);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
