// Levenberg-Marquardt: the cases of all minimizers, singular Gauss-Newton matrices, damping rules.
#include "majorant/framework/levenberg_marquardt.h"

#include <cmath>

#include "framework/minimizer_cases.h"
#include "majorant/framework/error.h"

namespace majorant {

struct LevenbergMarquardtTraits {
  static constexpr Status kAmongGaps = Status::Converged;
  static std::unique_ptr<Minimizer> make(int max_iterations) {
    LevenbergMarquardtOptions o;
    o.stopping.max_iterations = max_iterations;
    return std::make_unique<LevenbergMarquardtMinimizer>(o);
  }
};

namespace test {
INSTANTIATE_TYPED_TEST_SUITE_P(LevenbergMarquardt, MinimizerCases,
                               testing::Types<LevenbergMarquardtTraits>);
}  // namespace test

namespace {

SolveResult minimize(const test::ChainProblem& chain, const DampingRules& damping) {
  LevenbergMarquardtOptions o;
  o.damping = damping;
  return LevenbergMarquardtMinimizer(o).minimize(chain.problem, chain.start, {});
}

// The first lambda is that of the rules; lambda falls if the model is right, down to its bound.
TEST(LevenbergMarquardt, LambdaFollowsTheGain) {
  const test::ChainProblem chain(20);
  const SolveResult result = minimize(chain, {.first = 10});
  ASSERT_EQ(result.status, Status::Converged);
  ASSERT_GT(result.iterations.size(), 3u);
  EXPECT_GE(result.iterations.front().shift, 10);
  EXPECT_LT(result.iterations.back().shift, 0.1);
  const SolveResult bounded = minimize(chain, {.first = 10, .smallest = 1});
  for (const IterationRecord& r : bounded.iterations) EXPECT_GE(r.shift, 1);
}

TEST(LevenbergMarquardt, RefusesInvalidRules) {
  const test::ChainProblem chain(5);
  EXPECT_THROW(minimize(chain, {.first = -1}), InvalidArgument);
  EXPECT_THROW(minimize(chain, {.smallest = 2, .largest = 1}), InvalidArgument);
  EXPECT_THROW(minimize(chain, {.first = std::nan("")}), InvalidArgument);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
