// Stop checks: their polls by evaluations, factorizations and minimizers, and the state after a
// stop.
#include "majorant/framework/stop_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "counted_stop.h"
#include "framework/barrier_chain.h"
#include "majorant/framework/ceres_minimizer.h"
#include "majorant/framework/first_order.h"
#include "majorant/framework/newton.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/problem_parts.h"

namespace majorant::test {
namespace {

TEST(StopCheck, NothingStopsByItself) {
  const StopCheck never;
  EXPECT_EQ(never(), Directive::Continue);
  EXPECT_NO_THROW(never.poll());
}

TEST(StopCheck, ReturnsTheReason) {
  for (const Directive why : {Directive::TimeLimit, Directive::Interrupt}) {
    const StopCheck stop([why] { return why; });
    try {
      stop.poll();
      ADD_FAILURE() << "no exception";
    } catch (const Stopped& stopped) {
      EXPECT_EQ(stopped.why(), why);
    }
    EXPECT_THROW(parallel_for(100, 1, [&](Index) { stop.poll(); }), Stopped);
  }
}

TEST(StopCheck, PollsAtMultiplesOfItsPeriod) {
  const CountedStop stop;
  for (std::size_t k = 0; k < 10 * StopCheck::kPeriod; ++k) stop.check().poll_at(k);
  EXPECT_EQ(stop.polls(), 10);
}

// There is a poll before each batch of elements, and no evaluation after a stop.
TEST(StopCheck, EvaluationsPollBeforeEveryBatch) {
  const ChainProblem chain(3000, 1);
  const long batches =
      ProblemParts::plan(chain.problem, chain.problem.terms().front()).batch_count();
  ASSERT_GE(batches, 20);
  Evaluator evaluator(chain.problem);
  Vec g, h;
  const auto expect_batches = [&](const auto& evaluate) {
    const CountedStop never;
    evaluate(never.check());
    EXPECT_EQ(never.polls(), batches);
    for (const long k : {1L, batches / 2, batches}) {
      const CountedStop stop(k);
      EXPECT_THROW(evaluate(stop.check()), Stopped);
      EXPECT_LE(stop.polls_after(), ThreadCount::current());  // threads that were already running
    }
  };
  expect_batches([&](const StopCheck& stop) { evaluator.value(chain.start, stop); });
  expect_batches([&](const StopCheck& stop) { evaluator.gradient(chain.start, g, stop); });
  expect_batches([&](const StopCheck& stop) {
    evaluator.linearize(chain.start, Curvature::Projected, g, h, stop);
  });
}

TEST(StopCheck, FactorizationsPollBeforeEveryShift) {
  SparsePattern pattern;
  pattern.size = 2;
  pattern.column_starts = {0, 2, 3};
  pattern.rows = {0, 1, 1};
  pattern.block_of = {0, 1};
  const Vec indefinite = Vec{{1, 3, 1}};  // needs several shifts
  const auto solver = make_eigen_ldlt_solver();
  solver->analyze(pattern);
  const CountedStop never;
  EXPECT_EQ(factorize_shifted(*solver, pattern, indefinite, 1e-3, never.check()).status,
            FactorStatus::Ok);
  ASSERT_GE(never.polls(), 4);
  for (long k = 1; k <= never.polls(); ++k) {
    const CountedStop stop(k);
    EXPECT_THROW(factorize_shifted(*solver, pattern, indefinite, 1e-3, stop.check()), Stopped);
    EXPECT_EQ(stop.polls_after(), 0);
  }
}

template <class M, class Options>
std::unique_ptr<Minimizer> made(const StopCheck& stop) {
  Options options;
  options.stop = stop;
  return std::make_unique<M>(options);
}

// A stopped minimizer immediately returns the last point that it reported.
TEST(StopCheck, MinimizersReturnTheLastAcceptedPoint) {
  const ChainProblem chain(20, 2);
  const long batches =
      ProblemParts::plan(chain.problem, chain.problem.terms().front()).batch_count();
  using Maker = std::unique_ptr<Minimizer> (*)(const StopCheck&);
  const Maker makers[] = {made<NewtonMinimizer, NewtonOptions>, made<LbfgsMinimizer, LbfgsOptions>,
                          made<GradientFlowMinimizer, GradientFlowOptions>,
                          made<CeresMinimizer, CeresOptions>};
  for (const Maker make : makers) {
    SCOPED_TRACE(&make - makers);
    std::vector<Vec> points{chain.start};
    StepObserver observe([&](const TraceEntry&, const Vec& y) {
      points.push_back(y);
      return Directive::Continue;
    });
    const CountedStop never;
    const SolveResult whole = make(never.check())->minimize(chain.problem, chain.start, &observe);
    // Each iteration has at least an evaluation with gradient and one of the line search.
    EXPECT_GE(never.polls(), 2 * batches * static_cast<long>(whole.iterations.size()));
    for (long k = 1; k <= never.polls(); k += std::max(1L, never.polls() / 30)) {
      points.assign(1, chain.start);
      const CountedStop stop(k);
      const SolveResult r = make(stop.check())->minimize(chain.problem, chain.start, &observe);
      if (r.status == Status::Converged)  // stopped during the test of the minimum
        EXPECT_EQ(r.definite, Definite::NotTested) << k;
      else
        EXPECT_EQ(r.status, Status::Interrupted) << k << ": " << r.message;
      EXPECT_EQ(r.y, points.back()) << k;
      EXPECT_EQ(r.iterations.size() + 1, points.size());
      EXPECT_LE(r.iterations.size(), whole.iterations.size());
      EXPECT_LE(stop.polls_after(), 60);  // Ceres may halve its step this often
      EXPECT_EQ(r.energy, Evaluator(chain.problem).value(r.y));
    }
  }
}

TEST(StopCheck, PiecesReportSharesOfTheWhole) {
  std::vector<double> notified;
  const StopCheck all = StopCheck().telling([&](double share) { notified.push_back(share); });
  const StopCheck half = all.between(0.5, 1);
  all.advance(0.25);
  half.advance(0.5);
  half.between(0, 0.4).advance(1, 4);
  half.silent().advance(1);
  half.asking([] { return Directive::Interrupt; }).advance(1);
  StopCheck().advance(0.7);
  EXPECT_EQ(notified, (std::vector<double>{0.25, 0.75, 0.55, 1}));
}

TEST(StopCheck, PiecesStopWithTheWhole) {
  const StopCheck stopped([] { return Directive::TimeLimit; });
  EXPECT_EQ(stopped.telling([](double) {}).between(0, 0.1)(), Directive::TimeLimit);
  EXPECT_EQ(stopped.silent()(), Directive::TimeLimit);
  EXPECT_EQ(stopped.asking([] { return Directive::Continue; })(), Directive::Continue);
}

TEST(StopCheck, LoopsReportProgressWhenTheyPoll) {
  int notified = 0;
  const StopCheck check = StopCheck().telling([&](double) { ++notified; });
  for (std::size_t k = 0; k < 3 * StopCheck::kPeriod; ++k) check.poll_at(k, 3 * StopCheck::kPeriod);
  EXPECT_EQ(notified, 3);
}

}  // namespace
}  // namespace majorant::test

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
