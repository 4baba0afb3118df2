// Ceres as a minimizer of a Problem: the cases of all minimizers, options, scale, the last
// iteration.
#include "majorant/framework/ceres_minimizer.h"

#include <glog/logging.h>

#include "framework/minimizer_cases.h"
#include "majorant/framework/error.h"

namespace majorant {

template <CeresOptions::Method method>
struct CeresTraits {
  static constexpr Status kAmongGaps =
      method == CeresOptions::Method::Lbfgs ? Status::Converged : Status::Stalled;
  static std::unique_ptr<Minimizer> make(int max_iterations) {
    FLAGS_minloglevel = google::GLOG_FATAL;  // suppresses messages
    CeresOptions o;
    o.method = method;
    o.max_iterations = max_iterations;
    return std::make_unique<CeresMinimizer>(o);
  }
};

namespace test {
using CeresKinds = testing::Types<CeresTraits<CeresOptions::Method::Lbfgs>,
                                  CeresTraits<CeresOptions::Method::NonlinearConjugateGradient>>;
INSTANTIATE_TYPED_TEST_SUITE_P(Ceres, MinimizerCases, CeresKinds);
}  // namespace test

namespace {

using test::ChainProblem;

// The gradient rule is absolute, so that energies of tiny scale need `scale`.
TEST(Ceres, TheScaleMakesTheGradientRuleRelative) {
  ChainProblem chain(10);
  TermState state;
  state.weight = 1e-12;
  const Problem tiny = chain.problem.with({{chain.problem.terms().front(), state}});
  const double best = 1e-12 * chain.term->best_energy();
  CeresOptions o;
  const SolveResult early = CeresMinimizer(o).minimize(tiny, chain.start, {});
  EXPECT_EQ(early.status, Status::Converged);
  EXPECT_GT(early.energy, 1.1 * best) << "1e-10 holds at once";
  o.scale = 1 / Evaluator(tiny).value(chain.start);
  const SolveResult r = CeresMinimizer(o).minimize(tiny, chain.start, {});
  EXPECT_EQ(r.status, Status::Converged) << r.message;
  EXPECT_NEAR(r.energy, best, 1e-10 * best);
}

TEST(Ceres, TheLastPointIsReportedOnce) {
  const ChainProblem chain(10);
  CeresOptions o;
  for (const double tolerance : {1e-1, 1e-3, 1e-6}) {
    o.function_tolerance = tolerance;
    int calls = 0;
    Vec last;
    StepObserver observer([&](const TraceEntry&, const Vec& y) {
      ++calls;
      EXPECT_TRUE(last.size() == 0 || y != last);
      last = y;
      return Directive::Continue;
    });
    const SolveResult r = CeresMinimizer(o).minimize(chain.problem, chain.start, &observer);
    EXPECT_EQ(r.status, Status::Converged);
    EXPECT_EQ(r.y, last);
    EXPECT_EQ(static_cast<int>(r.iterations.size()), calls);
    EXPECT_LE(r.iterations.back().relative_decrease, tolerance);
    EXPECT_GT(r.iterations.back().step, 0);
  }
}

TEST(Ceres, GradientsAreNotEvaluatedOutsideTheDomain) {
  test::Scalar barrier = test::log_barrier();
  int outside = 0, values_outside = 0;
  barrier.f = [&, f = barrier.f](double t) {
    values_outside += t <= 0;
    return f(t);
  };
  barrier.f1 = [&, f1 = barrier.f1](double t) {
    outside += t <= 0;
    return f1(t);
  };
  const Problem problem = test::chain_of(2, barrier);
  const SolveResult r = CeresMinimizer().minimize(problem, Vector2(1.2, 0.9), {});
  EXPECT_EQ(r.status, Status::Converged) << r.message;
  const SolveResult far = CeresMinimizer().minimize(problem, Vector2(30, 0.01), {});
  EXPECT_EQ(far.status, Status::Converged) << far.message;
  EXPECT_GT(values_outside, 0) << "the case is not tested";
  EXPECT_EQ(outside, 0);
}

TEST(Ceres, BadOptionsThrow) {
  const ChainProblem chain(3);
  for (const CeresOptions& o : {CeresOptions{.max_iterations = -1}, CeresOptions{.history = 0},
                                CeresOptions{.scale = 0}, CeresOptions{.scale = -1}})
    EXPECT_THROW(CeresMinimizer(o).minimize(chain.problem, chain.start, {}), InvalidArgument);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
