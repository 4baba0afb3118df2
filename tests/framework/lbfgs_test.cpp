// L-BFGS in a factored metric: the cases of all minimizers, and the effects of history and metric.
#include "framework/counting_solver.h"
#include "framework/minimizer_cases.h"
#include "majorant/framework/error.h"
#include "majorant/framework/first_order.h"
#include "majorant/framework/internal/preconditioner.h"
#include "majorant/framework/newton.h"

namespace majorant {

struct LbfgsTraits {
  static constexpr Status kAmongGaps = Status::Converged;
  static std::unique_ptr<Minimizer> make(int max_iterations) {
    LbfgsOptions o;
    o.stopping.max_iterations = max_iterations;
    return std::make_unique<LbfgsMinimizer>(o);
  }
};

namespace test {
using LbfgsKinds = testing::Types<LbfgsTraits>;
INSTANTIATE_TYPED_TEST_SUITE_P(Lbfgs, MinimizerCases, LbfgsKinds);
}  // namespace test

namespace {

using test::ChainProblem;
using test::QuadraticTerm;
using test::Random;
using test::Rows;

Problem random_quadratic(unsigned seed) {
  Random random(seed);
  const auto term =
      std::make_shared<const QuadraticTerm>(test::band_elements(30, 3, 2), random, true);
  Rows rows;
  rows.row({{0, 1}, {7, 1}}, 1).row({{5, 1}, {9, -1}}, 0.5);
  return ProblemBuilder(64).add(term, 1.0).add(rows).build();
}

TEST(Lbfgs, SolvesAQuadraticInOneStepWithItsOwnMetric) {
  const Problem problem = random_quadratic(1);
  const SolveResult r = LbfgsMinimizer().minimize(problem, Random(2).vector(62), {});
  ASSERT_EQ(r.status, Status::Converged) << r.message;
  EXPECT_EQ(r.iterations.size(), 1u);
  EXPECT_NEAR(r.iterations[0].step, 1, 1e-6);
  Vec g;
  Evaluator(problem).gradient(r.y, g);
  EXPECT_LE(g.norm(), 1e-8 * r.iterations[0].gradient_norm);
}

TEST(Lbfgs, RecordsCountFactorizations) {
  const ChainProblem chain(40);
  const auto counts = std::make_shared<test::SolverCounts>();
  LbfgsOptions o;
  o.curvature = Curvature::Exact;  // indefinite at the start: shifted
  o.stopping.max_iterations = 17;
  o.linear_solver = test::counting(counts);
  const SolveResult r = LbfgsMinimizer(o).minimize(chain.problem, chain.start, {});
  ASSERT_EQ(r.iterations.size(), 17u);
  EXPECT_GT(counts->failed, 0);
  EXPECT_EQ(test::recorded(r.iterations).factorizations, counts->factorizations);
  EXPECT_EQ(test::recorded(r.iterations).failed, counts->failed);
  for (std::size_t k = 0; k < 17; ++k) EXPECT_EQ(r.iterations[k].factorizations > 0, k == 0) << k;
}

// With an arbitrary metric and enough history, a quadratic of n unknowns takes about n steps, and
// far more without history.
TEST(Lbfgs, HistoryMakesUpForAPoorMetric) {
  Random random(3);
  const auto term =
      std::make_shared<const QuadraticTerm>(test::band_elements(10, 3, 1), random, true);
  const Problem problem = ProblemBuilder(12).add(term, 1).build();
  LbfgsOptions o;
  o.metric = test::chain_of(12, test::parabola(0, 0));
  o.history = 30;
  const Vec y0 = random.vector(12);
  const SolveResult r = LbfgsMinimizer(o).minimize(problem, y0, {});
  const SolveResult newton = NewtonMinimizer().minimize(problem, y0, {});
  EXPECT_EQ(r.status, Status::Converged) << r.message;
  EXPECT_NEAR(r.energy, newton.energy, 1e-10 * std::abs(newton.energy));
  EXPECT_LE(r.iterations.size(), 40u);
  o.history = 0;
  const SolveResult slow = LbfgsMinimizer(o).minimize(problem, y0, {});
  EXPECT_GE(slow.iterations.size(), 2 * r.iterations.size());
}

// cautious = 1 requires parallel s and q: no pair passes, which gives gradient descent in the
// metric.
TEST(Lbfgs, CautiousnessDecidesOnPairs) {
  const ChainProblem chain(10);
  LbfgsOptions none, strict, usual;
  for (LbfgsOptions* o : {&none, &strict, &usual}) o->stopping.max_iterations = 8;
  none.history = 0;
  strict.cautious = 1;
  const auto last = [&](const LbfgsOptions& o) {
    return LbfgsMinimizer(o).minimize(chain.problem, chain.start, {}).y;
  };
  EXPECT_EQ(last(none), last(strict));
  EXPECT_NE(last(none), last(usual));
}

// Pairs of negative curvature, admitted on purpose, make B indefinite in concave regions: ascent
// directions are replaced by those of the metric.
TEST(Lbfgs, RestartsWithTheMetricWhereTheDirectionIsNoDescent) {
  const Problem hill = test::chain_of(
      1,
      {[](double t) { return t < 10 ? -t * t / 2 : -50 - 10 * (t - 10) + 5 * (t - 10) * (t - 10); },
       [](double t) { return t < 10 ? -t : -10 + 10 * (t - 10); },
       [](double t) { return t < 10 ? -1.0 : 10.0; }});
  LbfgsOptions o;
  o.metric = test::chain_of(1, test::parabola(0, 0));
  o.cautious = -2;
  o.line_search.largest_growth = 1;  // several steps on the concave side
  const SolveResult r = LbfgsMinimizer(o).minimize(hill, Vec::Constant(1, 1), {});
  EXPECT_EQ(r.status, Status::Converged) << r.message;
  EXPECT_NEAR(r.y[0], 11, 1e-6);
  EXPECT_NEAR(r.iterations.at(1).newton_decrement, 1.5 * 1.5 / 2, 1e-12) << "g.M^-1 g";
}

// In a nonconvex valley, pairs of negative curvature are skipped.
TEST(Lbfgs, PairsOfNegativeCurvatureDoNotBreakIt) {
  const Problem problem = test::chain_of(4, test::double_well());
  LbfgsOptions o;
  o.curvature = Curvature::Exact;  // indefinite at the start: shifted
  Vec y0(4);
  y0 << 0.05, -0.1, 0.4, 2.5;
  StepObserver observer([](const TraceEntry& row, const Vec&) {
    EXPECT_GT(row.record.newton_decrement, 0);
    return Directive::Continue;
  });
  const SolveResult r = LbfgsMinimizer(o).minimize(problem, y0, &observer);
  EXPECT_EQ(r.status, Status::Converged) << r.message;
  EXPECT_GT(r.iterations[0].shift, 0);
  EXPECT_NEAR(r.energy, 4, 1e-8);
}

TEST(Lbfgs, RefusesForeignMetrics) {
  const ChainProblem chain(5);
  LbfgsOptions o;
  o.metric = test::chain_of(6, test::parabola(0, 0));  // without a constraint
  EXPECT_THROW(LbfgsMinimizer(o).minimize(chain.problem, chain.start, {}), InvalidArgument);
  o.metric.reset();
  o.curvature = Curvature::Reweighted;
  EXPECT_THROW(LbfgsMinimizer(o).minimize(chain.problem, chain.start, {}), InvalidArgument);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
