#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "framework/scalar_terms.h"
#include "framework/step_reports.h"
#include "majorant/framework/minimizer.h"
#include "majorant/framework/newton.h"

namespace majorant::test {
namespace {

using Outcome = StepResult::Outcome;
using Since = StoppingTest::Since;

TEST(Stopping, StepsWithProgressGoOnUntilTheIterationsAreUsedUp) {
  StoppingTest test(usual_rules(), 100);
  for (int k = 0; k < 7; ++k) {
    EXPECT_FALSE(test.before_step().has_value()) << k;
    const Advice advice = test.after(moved(0.1, 0.2));
    expect_goes_on(advice);
    EXPECT_TRUE(advice.fallback);
    EXPECT_FALSE(advice.polish);
  }
  ASSERT_TRUE(test.before_step().has_value());
  EXPECT_EQ(test.before_step()->status, Status::MaxIterations);
  EXPECT_FALSE(test.before_step()->at_fallback);
}

TEST(Stopping, ASmallStepNearAMinimumIsPolishedOnceThenConverged) {
  StoppingTest test(usual_rules(), 100);
  const Advice first = test.after(moved(9e-7, 9e-6));
  expect_goes_on(first);
  EXPECT_TRUE(first.polish);
  expect_goes_on(test.after(moved(0.1, 0.2)));  // polishing is not requested again
  expect_stop(test.after(moved(9e-7, 9e-6)), Status::Converged, "relative decrease");
}

TEST(Stopping, TheTailHasTheRequestedNumberOfSmallSteps) {
  for (const int steps : {1, 2, 4}) {
    StoppingRules patient = usual_rules();
    patient.tail_steps = steps;
    patient.stall_iterations = 100;
    StoppingTest test(patient, 100);
    double decrease = 9e-7;  // each is a tenth of the last one, hence no plateau
    for (int k = 1; k < steps; ++k, decrease /= 10) {
      const Advice advice = test.after(moved(decrease, 9e-6));
      expect_goes_on(advice);
      EXPECT_EQ(advice.polish, k == 1);
    }
    expect_stop(test.after(moved(decrease, 9e-6)), Status::Converged, "relative decrease");
  }
}

TEST(Stopping, TheTailNeedsASmallDecrementAndAModelThatIsNotExact) {
  {
    StoppingTest test(usual_rules(), 100);
    EXPECT_FALSE(test.after(moved(9e-7, 1.1e-5)).polish) << "decrement too large";
  }
  StoppingTest test(usual_rules(), 100);
  const Advice exact = test.after(moved(9e-7, 9e-6, 1, Curvature::Exact));
  EXPECT_FALSE(exact.polish) << "exact steps end by the decrement rule";
  expect_goes_on(exact);
}

TEST(Stopping, ASmallStepBeforeAChangeOfTheProblemIsNoSignOfAMinimum) {
  StoppingTest test(usual_rules(), 100);
  for (int k = 0; k < 2; ++k) {
    const Advice advice = test.after(moved(9e-7, 9e-6), Since::ProblemChanged);
    EXPECT_FALSE(advice.polish);
    expect_goes_on(advice);
  }
  // this does not continue indefinitely
  expect_stop(test.after(moved(9e-7, 9e-6), Since::ProblemChanged), Status::Converged,
              "relative decrease");
}

TEST(Stopping, ABlockedStepIsRepeatedIfTheProblemChanges) {
  for (const auto outcome : {StepResult::Outcome::Blocked, StepResult::Outcome::NoDecrease}) {
    StepResult held = moved(0, 1e-2);
    held.outcome = outcome;
    StoppingTest test(usual_rules(), 100);
    for (int k = 0; k < 3; ++k) expect_goes_on(test.after(held, Since::ProblemChanged));
    expect_stop(test.after(held, Since::ProblemChanged), Status::Stalled, kNotAsPromised);
    StoppingTest same(usual_rules(), 100);
    expect_stop(same.after(held), Status::Stalled, kNotAsPromised);
  }
}

TEST(Stopping, IdleStepsInARowStallFarFromAMinimumAndReturnToTheFallback) {
  StoppingTest test(usual_rules(), 100);
  EXPECT_FALSE(test.after(moved(9e-7, 1e-2)).fallback);
  EXPECT_FALSE(test.after(moved(0.1, 1e-2, 9e-4)).fallback) << "a certified step below stall_step";
  expect_goes_on(test.after(moved(0.1, 1e-2)));  // the row of small steps is interrupted
  expect_goes_on(test.after(moved(9e-7, 1e-2)));
  expect_goes_on(test.after(moved(0.1, 1e-2, 9e-4)));
  const Advice last = test.after(moved(9e-7, 1e-2));
  expect_stop(last, Status::Stalled, "held at the limit of the feasible set");
  EXPECT_TRUE(last.stop->at_fallback);
}

// The message names the reason of idle steps, the feasible set before the domain; progress in
// between resets it.
TEST(Stopping, TheMessageOfAStallNamesTheLimitOfItsSteps) {
  const auto message_of = [](std::initializer_list<StepLimit> limits) {
    StoppingTest test(usual_rules(), 100);
    Advice advice;
    for (const StepLimit limit : limits) {
      StepResult step = moved(9e-7, 1e-2);
      step.record.limit = limit;
      advice = test.after(step);
    }
    return advice.stop ? advice.stop->message : "";
  };
  using enum StepLimit;
  EXPECT_EQ(message_of({None, None, None}), kNotAsPromised);
  EXPECT_EQ(message_of({Energy, None, Energy}), kNotAsPromised);
  EXPECT_EQ(message_of({Energy, Domain, None}), "held at the limit of the energy's domain");
  EXPECT_EQ(message_of({Checker, Domain, Energy}), "held at the limit of the feasible set");

  for (const auto& [limit, message] : {std::pair{Energy, kNotAsPromised},
                                       {Domain, "held at the limit of the energy's domain"},
                                       {Checker, "held at the limit of the feasible set"}}) {
    StoppingTest test(usual_rules(), 100);
    StepResult step = moved(9e-7, 1e-2);
    step.record.limit = Checker;
    expect_goes_on(test.after(step));
    expect_goes_on(test.after(moved(0.1, 1e-2)));
    step = ended(Outcome::NoDecrease, 1e-2);
    step.record.limit = limit;
    expect_stop(test.after(step), Status::Stalled, message);
  }
}

// A wrong model may predict a large decrease at a minimum, so that the exact Hessian is tried
// first.
TEST(Stopping, AStallIsAnsweredByTheExactHessianOnce) {
  StoppingRules rules = usual_rules();
  rules.second_chances = 1;
  rules.max_iterations = 100;
  StoppingTest test(rules, 100);
  for (int k = 0; k < 2; ++k) expect_goes_on(test.after(moved(9e-7, 1e-2)));
  Advice advice = test.after(moved(9e-7, 1e-2));
  expect_goes_on(advice);
  EXPECT_TRUE(advice.polish);
  for (int k = 0; k < 2; ++k) expect_goes_on(test.after(moved(9e-7, 1e-2)));
  expect_stop(test.after(moved(9e-7, 1e-2)), Status::Stalled, kNotAsPromised);

  StoppingTest blocked(rules, 100);
  advice = blocked.after(ended(Outcome::NoDecrease, 1e-2));
  expect_goes_on(advice);
  EXPECT_TRUE(advice.polish);
  expect_stop(blocked.after(ended(Outcome::NoDecrease, 1e-2)), Status::Stalled, kNotAsPromised);
}

TEST(Stopping, IdleStepsNearAMinimumConvergeWhereTheyAre) {
  StoppingTest test(usual_rules(), 100);
  expect_goes_on(test.after(moved(9e-7, 9e-5)));
  expect_goes_on(test.after(moved(4e-7, 9e-5)));
  const Advice last = test.after(moved(1e-7, 9e-5));
  expect_stop(last, Status::Converged, "relative decrease");
  EXPECT_FALSE(last.stop->at_fallback);
}

// The larger of tolerance and stall_decrement decides what is near a minimum: with a loose
// tolerance, a run does not stall for a small predicted decrease.
TEST(Stopping, NearAMinimumIsTheLargerOfToleranceAndStallDecrement) {
  const auto status_of = [](double tolerance, double decrement) {
    StoppingRules loose = usual_rules();
    loose.relative_decrease = tolerance;
    loose.tail_steps = 100;  // only idle steps end the run
    StoppingTest test(loose, 100);
    Advice advice;
    for (const double decrease : {9e-7, 4e-7, 1e-7})
      advice = test.after(moved(decrease, decrement));
    return advice.stop ? advice.stop->status : Status::Failed;
  };
  EXPECT_EQ(status_of(1e-3, 0.9e-2), Status::Converged);
  EXPECT_EQ(status_of(1e-3, 1.1e-2), Status::Stalled);
  EXPECT_EQ(status_of(1e-6, 0.9e-4), Status::Converged);
  EXPECT_EQ(status_of(1e-6, 1.1e-4), Status::Stalled);
}

TEST(Stopping, OnlyAGoodPartOfAStepMakesAFallback) {
  StoppingTest test(usual_rules(), 100);
  EXPECT_TRUE(test.after(moved(0.1, 0.2, 0.1)).fallback);
  EXPECT_FALSE(test.after(moved(0.1, 0.2, 0.09)).fallback);
}

TEST(Stopping, AStepThatDidNotMoveEndsTheRun) {
  const auto answer = [](const StepResult& step) {
    return StoppingTest(usual_rules(), 100).after(step);
  };
  expect_stop(answer(ended(Outcome::AtMinimum)), Status::Converged, "decrement");
  expect_stop(answer(ended(Outcome::Breakdown)), Status::Failed, "no finite direction");
  for (const Outcome outcome : {Outcome::Blocked, Outcome::NoDecrease}) {
    expect_stop(answer(ended(outcome, 9e-5)), Status::Converged, "no further decrease");
    expect_stop(answer(ended(outcome, 1.1e-4)), Status::Stalled, kNotAsPromised);
  }
  StepResult limit = ended(Outcome::Stopped);
  limit.why = Directive::TimeLimit;
  expect_stop(answer(limit), Status::TimeLimit, "the time limit was reached");
  limit.why = Directive::Interrupt;
  expect_stop(answer(limit), Status::Interrupted, "interrupted");
}

// Decrements are compared with the energy before the step, but at least with 1e-14 of the first
// one; smaller energies and decrements are rounding errors.
TEST(Stopping, EnergiesThatVanishHaveTheScaleOfTheirStart) {
  const auto blocked_at = [](double energy, double first) {
    StepResult step = ended(Outcome::Blocked, 0);
    step.energy_before = energy;
    step.record.newton_decrement = 1e-19;
    return StoppingTest(usual_rules(), first).after(step).stop->status;
  };
  EXPECT_EQ(blocked_at(0, 1), Status::Converged);
  EXPECT_EQ(blocked_at(0, 1e-4), Status::Converged);   // 1e-19 <= 1e-14 * 1e-4
  EXPECT_EQ(blocked_at(0, 1e-6), Status::Stalled);     // 1e-19 > 1e-14 * 1e-6
  EXPECT_EQ(blocked_at(-1e-2, 0), Status::Converged);  // sizes count, not signs
}

TEST(Stopping, BriefRulesEndWithTheFirstSmallStep) {
  StoppingTest test(brief_rules(3, 1e-2), 100);
  expect_goes_on(
      test.after(moved(0.1, 0.2, 1e-9)));  // progress counts, even with a short step bound
  const Advice small = test.after(moved(9e-3, 0.2));
  expect_stop(small, Status::Converged, "relative decrease");

  StoppingTest limited(brief_rules(2, -std::numeric_limits<double>::infinity()), 100);
  expect_goes_on(limited.after(moved(0, 0)));
  expect_goes_on(limited.after(moved(0, 0)));
  EXPECT_TRUE(limited.before_step().has_value());
}

// Stepper::minimize obeys the test: at a bound that blocks all steps, the result is the fallback.
TEST(Stopping, MinimizeReturnsToTheFallback) {
  const auto well = std::make_shared<const Chain>(1, parabola(5, 1));
  // The wall at 1 allows a tenth of the distance to it, then smaller and smaller fractions.
  class Wall final : public FeasibilityChecker {
   public:
    std::string_view name() const override { return "wall"; }
    Verdict check(VecIn x) const override {
      Verdict verdict;
      verdict.feasible = x[0] < 1;
      return verdict;
    }
    StepBound max_step(VecIn x, VecIn d, double) const override {
      const double way = 1 - x[0];
      return {way > 0.75 ? 0.2 : 1e-4 * way / d[0], {0}};
    }
  };
  ProblemBuilder builder(1);
  builder.add(well, 1.0);
  builder.add(std::make_shared<const Wall>());
  NewtonOptions options;
  options.blend.below = 0;
  options.shifts.short_step = 0;  // the bound is too near, not the direction too long
  NewtonStepper stepper(builder.build(), options);
  std::vector<double> points;
  StepObserver observer([&](const TraceEntry& row, const Vec& y) {
    if (row.record.step_bound >= 0.1) points.push_back(y[0]);
    return Directive::Continue;
  });
  StoppingRules rules;
  rules.fallback_step = 0.1;
  const SolveResult r = stepper.minimize(Vec::Zero(1), rules, &observer);
  EXPECT_EQ(r.status, Status::Stalled) << r.message;
  ASSERT_FALSE(points.empty());
  EXPECT_EQ(r.y[0], points.back());
  EXPECT_GT(r.iterations.size(), points.size());
}

}  // namespace
}  // namespace majorant::test

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
