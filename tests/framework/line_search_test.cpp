// Tests of the feasible line search alone.
#include "majorant/framework/line_search.h"

#include <gtest/gtest.h>

#include "framework/scalar_terms.h"

namespace majorant {
namespace {

using test::Box;
using test::Chain;
using test::parabola;
using test::Scalar;

// (x - 1)^2 + 1 from x = 0 along p, so that -g.p = 2 p and the minimum is at s = 1 / p.
struct Line {
  explicit Line(double slope, std::shared_ptr<const FeasibilityChecker> checker = nullptr,
                Scalar f = parabola(1, 1))
      : p(Vec::Constant(1, slope)), evaluator(make(std::move(checker), std::move(f))) {}
  static Problem make(std::shared_ptr<const FeasibilityChecker> checker, Scalar f) {
    ProblemBuilder builder(1);
    builder.add(std::make_shared<const Chain>(1, std::move(f)), 1);
    if (checker) builder.add(std::move(checker));
    return builder.build();
  }
  LineSearch search() { return {evaluator, options, y, p, evaluator.value(y), 2 * p[0]}; }

  LineSearchOptions options;
  Vec y = Vec::Zero(1), p;
  Evaluator evaluator;
};

TEST(LineSearch, FindsTheMinimumOfAParabolaFromBothSides) {
  for (const double slope : {1.0, 1.9, 0.01, 50.0}) {
    Line line(slope);
    LineSearch s = line.search();
    ASSERT_EQ(s.find(1), LineSearch::Result::Accepted);
    EXPECT_NEAR(s.step() * slope, 1, 0.25) << slope;
    EXPECT_EQ(s.energy(), line.evaluator.value(line.y + s.step() * line.p));
    EXPECT_LT(s.energy(), 1.07);
    EXPECT_EQ(s.bound().step, 1);
  }
}

TEST(LineSearch, TheFirstTrialIsTheCallersChoice) {
  Line line(1e-6);
  LineSearch slow = line.search(), fast = line.search();
  ASSERT_EQ(slow.find(1), LineSearch::Result::Accepted);
  ASSERT_EQ(fast.find(1e6), LineSearch::Result::Accepted);
  EXPECT_EQ(fast.trials(), 1);
  EXPECT_EQ(fast.step(), 1e6);
  EXPECT_GT(slow.trials(), 5);
  Line steep(1e6);
  LineSearch small = steep.search();
  ASSERT_EQ(small.find(1e-6), LineSearch::Result::Accepted);
  EXPECT_EQ(small.trials(), 1);
  EXPECT_EQ(small.bound().step, 1) << "a short first trial is no limit of the feasible set";
}

TEST(LineSearch, StaysWithinTheCertifiedStep) {
  const auto box = std::make_shared<const Box>(0.5, true);
  Line line(1, box);
  LineSearch s = line.search();
  ASSERT_EQ(s.find(1), LineSearch::Result::Accepted);
  EXPECT_EQ(s.bound().step, 0.5);
  EXPECT_EQ(s.bound().blocking, std::vector<Index>{0});
  EXPECT_DOUBLE_EQ(s.step(), line.options.boundary_fraction * 0.5);
  LineSearch far = line.search();
  ASSERT_EQ(far.find(0.01), LineSearch::Result::Accepted);
  EXPECT_GT(far.step(), 0.01);
  EXPECT_LT(far.step(), 0.5) << "growth asks the checkers again";
}

TEST(LineSearch, EndPointsAreCheckedWhereNoPathIsCertified) {
  Line line(1, std::make_shared<const Box>(0.3, false));
  LineSearch s = line.search();
  ASSERT_EQ(s.find(1), LineSearch::Result::Accepted);
  EXPECT_EQ(s.step(), 0.25);
  EXPECT_EQ(s.bound().step, 1);
}

TEST(LineSearch, BlockedAndNoDecrease) {
  Line frozen(1, std::make_shared<const test::Frozen>());
  LineSearch s = frozen.search();
  EXPECT_EQ(s.find(1), LineSearch::Result::Blocked);
  EXPECT_EQ(s.bound().blocking, std::vector<Index>{3});
  EXPECT_EQ(s.trials(), 0);

  Line wall(1, nullptr,
            {[](double t) { return t == 0 ? 1.0 : std::nan(""); }, [](double) { return -2.0; },
             [](double) { return 1.0; }});
  LineSearch t = wall.search();
  EXPECT_EQ(t.find(1), LineSearch::Result::NoDecrease);
  EXPECT_EQ(t.step(), 0);
  EXPECT_EQ(t.trials(), 47) << "halvings of 1 above smallest_step";
}

// The reason why no longer step was found: the test that refused the last one.
TEST(LineSearch, ReportsTheReasonOfAShortStep) {
  const auto limit = [](double slope, std::shared_ptr<const FeasibilityChecker> checker,
                        const Scalar& f = parabola(1, 1)) {
    Line line(slope, std::move(checker), f);
    LineSearch s = line.search();
    s.find(1);
    return s.limit();
  };
  const Scalar wall{[](double t) { return t < 0.3 ? -t : std::nan(""); },
                    [](double) { return -1.0; }, [](double) { return 1.0; }};
  using enum StepLimit;
  EXPECT_EQ(limit(1, nullptr), None);
  EXPECT_EQ(limit(0.01, std::make_shared<const Box>(0.5, true)), None) << "growth does not count";
  EXPECT_EQ(limit(50, nullptr), Energy);
  EXPECT_EQ(limit(50, std::make_shared<const Box>(9, true)), Energy) << "the box is farther";
  EXPECT_EQ(limit(1, nullptr, wall), Domain);
  EXPECT_EQ(limit(1, std::make_shared<const Box>(0.5, true)), Checker);
  EXPECT_EQ(limit(1, std::make_shared<const Box>(0.3, false)), Checker);
  EXPECT_EQ(limit(1, std::make_shared<const test::Frozen>()), Checker);
}

// For the barrier energy E = 1 / (1 + s / 3)^2 the parabola gives the step 1.455.
TEST(LineSearch, DoublesInTheBarrierPhase) {
  const Scalar barrier{[](double t) { return std::pow(1 + t / 3, -2); },
                       [](double t) { return -2.0 / 3 * std::pow(1 + t / 3, -3); },
                       [](double t) { return 2.0 / 3 * std::pow(1 + t / 3, -4); }};
  const auto step = [&](std::shared_ptr<const FeasibilityChecker> checker, auto change) {
    Line line(1, std::move(checker), barrier);
    change(line.options);
    LineSearch s(line.evaluator, line.options, line.y, line.p, 1, 2.0 / 3);
    EXPECT_EQ(s.find(1), LineSearch::Result::Accepted);
    EXPECT_EQ(s.energy(), line.evaluator.value(line.y + s.step() * line.p));
    return s.step();
  };
  const auto usual = [](LineSearchOptions&) {};
  EXPECT_EQ(step(nullptr, usual), 256) << "most_improvements doublings";
  EXPECT_NEAR(step(nullptr, [](auto& o) { o.barrier_decrement = 0.7; }), 1.455, 0.6);
  EXPECT_EQ(step(nullptr, [](auto& o) { o.barrier_gain = 0.4; }), 2) << "gains 0.36, 0.49, ...";
  EXPECT_DOUBLE_EQ(step(std::make_shared<const Box>(6, true), usual), 0.9 * 6);
}

// The Armijo rule refuses the tiny decrease of a step that overshoots.
TEST(LineSearch, RefusesTooLittleDecrease) {
  Line line(1.99999);
  LineSearch s = line.search();
  line.options.armijo = 0.3;
  ASSERT_EQ(s.find(1), LineSearch::Result::Accepted);
  EXPECT_LE(s.energy(), 2 - 0.3 * s.step() * 2 * 1.99999);
  EXPECT_LT(s.step(), 0.8);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
