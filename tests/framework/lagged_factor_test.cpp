// Steps of Newton's method with a lagged factor: the cases of all minimizers, and the life of a
// factor.
#include <cmath>
#include <optional>

#include "framework/counting_solver.h"
#include "framework/minimizer_cases.h"
#include "majorant/framework/internal/lbfgs_history.h"
#include "majorant/framework/internal/preconditioner.h"
#include "majorant/framework/newton.h"

namespace majorant {

struct LaggedFactorTraits {
  static constexpr Status kAmongGaps = Status::Converged;
  static std::unique_ptr<Minimizer> make(int max_iterations) {
    NewtonOptions o;
    o.lagged = {.below = test::kInfinity, .steps = 4};
    o.stopping.max_iterations = max_iterations;
    return std::make_unique<NewtonMinimizer>(o);
  }
};

namespace test {
INSTANTIATE_TYPED_TEST_SUITE_P(LaggedFactor, MinimizerCases, testing::Types<LaggedFactorTraits>);
}  // namespace test

namespace {

// Steps without a factorization are as many as allowed, and reach the same minimum.
TEST(LaggedFactors, ServeSeveralSteps) {
  const test::ChainProblem chain(60);
  NewtonOptions o;
  const SolveResult plain = NewtonMinimizer(o).minimize(chain.problem, chain.start, {});
  const auto counts = std::make_shared<test::SolverCounts>();
  o.linear_solver = test::counting(counts);
  o.lagged.below = test::kInfinity;
  o.lagged.steps = 3;
  const SolveResult r = NewtonMinimizer(o).minimize(chain.problem, chain.start, {});
  ASSERT_EQ(r.status, Status::Converged) << r.message;
  EXPECT_NEAR(r.energy, plain.energy, 1e-6 * std::abs(plain.energy));
  int kept = 0, longest = 0, run = 0;
  for (std::size_t k = 0; k < r.iterations.size(); ++k) {
    run = r.iterations[k].factorizations > 0 ? 0 : run + 1;
    kept += run > 0;
    longest = std::max(longest, run);
    if (run > 1) {
      EXPECT_GE(r.iterations[k - 1].step, o.lagged.short_step);
    }
  }
  EXPECT_GT(kept, 3);
  EXPECT_EQ(longest, 3);
  EXPECT_LT(counts->factorizations, test::recorded(plain.iterations).factorizations);
  o.lagged.short_step = test::kInfinity;
  for (const IterationRecord& each :
       NewtonMinimizer(o).minimize(chain.problem, chain.start, {}).iterations)
    EXPECT_GT(each.factorizations, 0);
}

// The first step with a lagged factor uses only the pair of the step before: older pairs belong to
// another metric.
TEST(LaggedFactors, BeginWithAnEmptyHistory) {
  const test::ChainProblem chain(10);
  NewtonOptions o;
  o.blend.below = 0;
  o.stopping = first_order_rules();
  o.lagged = {.below = test::kInfinity, .steps = 3, .short_step = 0};
  Preconditioner metric(chain.problem, Curvature::Projected, make_direct_solver());
  Evaluator evaluator(chain.problem);
  Vec here = chain.start, g, p;
  std::optional<History> history;  // after the step with the new factor
  int factors = 0;
  StepObserver observer([&](const TraceEntry& row, const Vec& y) {
    const IterationRecord& r = row.record;
    evaluator.gradient(here, g);
    if (r.factorizations > 0) {
      EXPECT_TRUE(metric.factorize(here));
      history.emplace(o.lagged.history, 1e-10);
      history->start(here, g);
    } else if (history) {
      history->visit(here, g);
      history->apply([&](const Vec& b, Vec& out) { metric.solve(b, out); }, -g, p);
      EXPECT_NEAR(r.newton_decrement, -g.dot(p), 1e-9 * r.newton_decrement) << r.iteration;
      history.reset();
      ++factors;
    }
    here = y;
    return Directive::Continue;
  });
  NewtonMinimizer(o).minimize(chain.problem, chain.start, &observer);
  EXPECT_GT(factors, 1);
}

// A factor is not used for another problem or for polishing steps.
TEST(LaggedFactors, AreNotForOtherProblemsAndPolishedSteps) {
  const test::ChainProblem chain(60);
  NewtonOptions o;
  o.lagged.below = test::kInfinity;
  o.lagged.short_step = 0;
  NewtonStepper stepper(chain.problem, o);
  Vec y = chain.start;
  double energy = stepper.evaluator().value(y);
  const auto factorizations = [&] { return stepper.step(y, energy).record.factorizations; };
  EXPECT_EQ(factorizations(), 1);
  EXPECT_EQ(factorizations(), 0);
  stepper.reset(chain.problem);
  EXPECT_EQ(factorizations(), 1);
  EXPECT_EQ(factorizations(), 0);
  stepper.polish();
  EXPECT_GE(factorizations(), 1);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
