// Requirements of every minimizer, as type-parametrized tests: instantiate with a traits class
//   struct MyTraits {
//     static std::unique_ptr<Minimizer> make(int max_iterations);
//     static constexpr Status kAmongGaps = Status::Converged;  // see NeverLeavesTheFeasibleSet
//   };
//   INSTANTIATE_TYPED_TEST_SUITE_P(Mine, MinimizerCases, MyTraits);
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "framework/barrier_chain.h"
#include "framework/scalar_terms.h"
#include "majorant/framework/minimizer.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/problem.h"
#include "majorant/framework/problem_parts.h"

namespace majorant::test {

inline Scalar log_barrier() {
  return {[](double t) { return t > 0 ? t - std::log(t) : kInfinity; },
          [](double t) { return 1 - 1 / t; }, [](double t) { return 1 / (t * t); }};
}

inline Problem chain_of(Index count, Scalar phi,
                        std::shared_ptr<const FeasibilityChecker> checker = nullptr) {
  ProblemBuilder builder(count);
  builder.add(std::make_shared<const Chain>(count, std::move(phi)), 1);
  if (checker) builder.add(std::move(checker));
  return builder.build();
}

template <class Traits>
class MinimizerCases : public testing::Test {
 protected:
  static SolveResult minimize(const Problem& problem, Vec y0, RunObserver* observer = nullptr,
                              int max_iterations = 20000) {
    return Traits::make(max_iterations)->minimize(problem, std::move(y0), observer);
  }
};
TYPED_TEST_SUITE_P(MinimizerCases);

// x_0 + x_n = 1, barriers, concave regions: the known minimum.
TYPED_TEST_P(MinimizerCases, ReachesTheKnownMinimumOfTheBarrierChain) {
  for (const auto& [gaps, seed] : {std::pair(3, 1u), {10, 1u}, {10, 2u}, {40, 3u}}) {
    const ChainProblem chain(gaps, seed);
    const SolveResult r = this->minimize(chain.problem, chain.start);
    const double best = chain.best_energy();
    ASSERT_GT(Evaluator(chain.problem).value(chain.start), best + 1);
    EXPECT_EQ(r.status, Status::Converged) << r.message;
    EXPECT_NEAR(r.energy, best, 1e-8 * std::abs(best)) << gaps << ' ' << seed;
    const Vec x = chain.problem.expand(r.y);
    EXPECT_LE((BarrierChain::gaps(x) - chain.term->best_gaps()).norm(),
              2e-4 * chain.term->best_gaps().norm());
    EXPECT_NEAR(x[0] + x[gaps], 1, 1e-12);
  }
}

TYPED_TEST_P(MinimizerCases, RecordsAgreeWithWhatHappens) {
  const ChainProblem chain(10);
  Evaluator evaluator(chain.problem);
  double previous = evaluator.value(chain.start);
  Vec last = chain.start, gradient;
  int calls = 0;
  StepObserver observer([&](const TraceEntry& row, const Vec& y) {
    const IterationRecord& r = row.record;
    EXPECT_EQ(r.iteration, ++calls);
    EXPECT_EQ(r.energy, evaluator.value(y));
    EXPECT_LE(r.energy, previous);
    EXPECT_NEAR(r.relative_decrease, (previous - r.energy) / std::abs(previous), 1e-12);
    evaluator.gradient(last, gradient);
    // Ceres uses a difference quotient as gradient, which is rounding error at the end.
    EXPECT_NEAR(r.gradient_norm, gradient.norm(), 1e-6 * gradient.norm() + 1e-13);
    EXPECT_GT(r.step, 0);
    EXPECT_GE(r.trials, 1);
    previous = r.energy;
    last = y;
    return Directive::Continue;
  });
  const SolveResult r = this->minimize(chain.problem, chain.start, &observer);
  EXPECT_EQ(r.status, Status::Converged);
  EXPECT_GE(calls, 5);
  ASSERT_EQ(static_cast<int>(r.iterations.size()), calls);
  EXPECT_EQ(r.y, last);
  EXPECT_EQ(r.energy, previous);
}

TYPED_TEST_P(MinimizerCases, NeverLeavesTheFeasibleSet) {
  // Gaps must exceed 0.3, and some start at 0.32 and grow; the minimum is inside.
  ChainProblem chain(10);
  const auto checker = std::make_shared<const MinimumGap>(0.3);
  Rows rows;
  rows.row({{0, 1}, {10, 1}}, 1);
  const Problem problem =
      ProblemBuilder(11).add(chain.term, ChainProblem::kWeight).add(rows).add(checker).build();
  ASSERT_GT(chain.term->best_gaps().minCoeff(), 0.31);
  Vec x(11);
  for (Index i = 0; i < 11; ++i) x[i] = 0.5 + (i < 5 ? 0.32 : 2.4) * (i - 5);
  x.array() += (1 - x[0] - x[10]) / 2;
  int calls = 0;
  StepObserver observer([&](const TraceEntry&, const Vec& y) {
    ++calls;
    EXPECT_TRUE(checker->check(problem.expand(y)).feasible);
    return Directive::Continue;
  });
  const SolveResult r = this->minimize(problem, problem.reduce(x), &observer);
  EXPECT_GT(calls, 3);
  // Methods that only test end points may stop at the boundary, but must report it.
  EXPECT_EQ(r.status, TypeParam::kAmongGaps) << r.message;
  const double excess = r.energy - chain.best_energy();
  EXPECT_EQ(r.status == Status::Converged, excess < 1e-8 * std::abs(chain.best_energy()));
}

// The minimum lies outside: the run ends at the boundary and does not report a minimum.
TYPED_TEST_P(MinimizerCases, StallsAtTheBoundary) {
  for (const bool paths : {true, false}) {
    const auto box = std::make_shared<const Box>(1, paths);
    const Problem problem = chain_of(2, parabola(2, 1), box);
    const SolveResult r = this->minimize(problem, Vector2(0.5, 0));
    EXPECT_EQ(r.status, Status::Stalled) << r.message << paths;
    EXPECT_TRUE(box->check(problem.expand(r.y)).feasible);
    EXPECT_GT(r.y.maxCoeff(), 0.8);
    EXPECT_EQ(r.energy, Evaluator(problem).value(r.y));
    if (paths) {
      EXPECT_FALSE(r.blocking.empty());
    }
  }
}

TYPED_TEST_P(MinimizerCases, InfeasibleStarts) {
  const Problem boxed = chain_of(3, parabola(0, 1), std::make_shared<const Box>(1, true));
  SolveResult r = this->minimize(boxed, Vector3(0, 7, 0));
  EXPECT_EQ(r.status, Status::Infeasible);
  EXPECT_EQ(r.blocking, std::vector<Index>{1});
  EXPECT_EQ(r.y, Vec(Vector3(0, 7, 0)));
  EXPECT_NE(r.message.find("box"), std::string::npos);

  const Problem domain = chain_of(1, log_barrier());
  EXPECT_EQ(this->minimize(domain, Vec::Constant(1, -1)).status, Status::Infeasible);
  EXPECT_THROW(this->minimize(domain, Vec::Constant(1, std::nan(""))), InvalidArgument);
  r = this->minimize(domain, Vec::Constant(1, 1e-3));
  EXPECT_EQ(r.status, Status::Converged) << r.message;
  EXPECT_NEAR(r.y[0], 1, 1e-3);
}

TYPED_TEST_P(MinimizerCases, ObserversStopIt) {
  const ChainProblem chain(10);
  for (const auto& [directive, status] : {std::pair(Directive::TimeLimit, Status::TimeLimit),
                                          {Directive::Interrupt, Status::Interrupted}}) {
    Vec seen;
    StepObserver observer([&, d = directive](const TraceEntry& row, const Vec& y) {
      seen = y;
      return row.record.iteration == 2 ? d : Directive::Continue;
    });
    const SolveResult r = this->minimize(chain.problem, chain.start, &observer);
    EXPECT_EQ(r.status, status);
    EXPECT_EQ(r.iterations.size(), 2u);
    EXPECT_EQ(r.y, seen);
    EXPECT_EQ(r.energy, Evaluator(chain.problem).value(r.y));
  }
}

TYPED_TEST_P(MinimizerCases, StopsAtTheIterationLimit) {
  const ChainProblem chain(10);
  for (const int limit : {0, 1, 2}) {
    const SolveResult r = this->minimize(chain.problem, chain.start, {}, limit);
    EXPECT_EQ(r.status, Status::MaxIterations);
    EXPECT_EQ(static_cast<int>(r.iterations.size()), limit);
    EXPECT_EQ(r.energy, Evaluator(chain.problem).value(r.y));
    EXPECT_EQ(r.y == chain.start, limit == 0);
  }
}

TYPED_TEST_P(MinimizerCases, WithoutUnknownsOrAtTheMinimumThereIsNothingToDo) {
  Rows rows;
  rows.row({{0, 1}}, 0.5);
  const Problem fixed =
      ProblemBuilder(1).add(std::make_shared<const Chain>(1, parabola(0, 1)), 1).add(rows).build();
  SolveResult r = this->minimize(fixed, Vec());
  EXPECT_EQ(r.status, Status::Converged);
  EXPECT_TRUE(r.iterations.empty());
  EXPECT_EQ(r.energy, 1.25);
  const Problem at = chain_of(3, parabola(2, 1));
  r = this->minimize(at, Vec::Constant(3, 2));
  EXPECT_EQ(r.status, Status::Converged);
  EXPECT_TRUE(r.iterations.empty());
}

TYPED_TEST_P(MinimizerCases, NonFiniteGradientsFail) {
  const Problem problem =
      chain_of(1, {[](double t) { return t; }, [](double) { return std::nan(""); },
                   [](double) { return 1.0; }});
  const SolveResult r = this->minimize(problem, Vec::Constant(1, 2));
  EXPECT_EQ(r.status, Status::Failed);
  EXPECT_EQ(r.y[0], 2);
  EXPECT_TRUE(r.iterations.empty());
}

// The energy is finite only near the start, where no minimum may be reported.
TYPED_TEST_P(MinimizerCases, EnergiesThatEndAreNotMinima) {
  for (const double beyond : {std::nan(""), kInfinity, -kInfinity}) {
    const Problem problem = chain_of(1, {[=](double t) { return t < 1 ? 5 - t : beyond; },
                                         [](double) { return -1.0; }, [](double) { return 1.0; }});
    const SolveResult r = this->minimize(problem, Vec::Zero(1));
    EXPECT_TRUE(std::isfinite(r.energy)) << beyond;
    EXPECT_LT(r.y[0], 1);
    EXPECT_GT(r.y[0], 0.5);
    EXPECT_NE(r.status, Status::MaxIterations);
  }
}

TYPED_TEST_P(MinimizerCases, DoesNotDependOnThreads) {
  const ChainProblem chain(3000);
  ASSERT_GT(ProblemParts::plan(chain.problem, chain.problem.terms().front()).batch_count(), 16);
  const ThreadCount alone(1);
  const SolveResult one = this->minimize(chain.problem, chain.start, {}, 15);
  ASSERT_EQ(one.iterations.size(), 15u);
  for (const int count : {2, 3}) {
    const ThreadCount threads(count);
    const SolveResult r = this->minimize(chain.problem, chain.start, {}, 15);
    EXPECT_EQ(r.y, one.y) << count;
    EXPECT_EQ(r.energy, one.energy);
  }
}

TYPED_TEST_P(MinimizerCases, PrintsNothing) {
  const ChainProblem chain(40, 3);
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  this->minimize(chain.problem, chain.start);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

REGISTER_TYPED_TEST_SUITE_P(MinimizerCases, ReachesTheKnownMinimumOfTheBarrierChain,
                            RecordsAgreeWithWhatHappens, NeverLeavesTheFeasibleSet,
                            StallsAtTheBoundary, InfeasibleStarts, ObserversStopIt,
                            StopsAtTheIterationLimit,
                            WithoutUnknownsOrAtTheMinimumThereIsNothingToDo, NonFiniteGradientsFail,
                            EnergiesThatEndAreNotMinima, DoesNotDependOnThreads, PrintsNothing);

}  // namespace majorant::test

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
