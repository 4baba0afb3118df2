#include "majorant/framework/stopping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "framework/scalar_terms.h"
#include "majorant/framework/newton.h"

namespace majorant::test {
namespace {

using Outcome = StepResult::Outcome;
using Since = StoppingTest::Since;

// From energy 100: what its parts say in the order of their names.
StepResult moved(double decrease, double decrement, double bound = 1,
                 Curvature curvature = Curvature::Projected) {
  StepResult step;
  step.outcome = Outcome::Moved;
  step.energy_before = 100;
  step.record.relative_decrease = decrease;
  step.record.energy = 100 * (1 - decrease);
  step.record.newton_decrement = 100 * decrement;
  step.record.step_bound = bound;
  step.record.curvature = curvature;
  return step;
}

StepResult ended(Outcome outcome, double decrement = 0) {
  StepResult step = moved(0, decrement, 0);
  step.outcome = outcome;
  return step;
}

StoppingRules rules() {
  StoppingRules r;
  r.relative_decrease = 1e-6;
  r.tail_factor = 10;
  r.stall_decrement = 1e-4;
  r.stall_iterations = 3;
  r.stall_step = 1e-3;
  r.anchor_step = 0.1;
  r.plateau_factor = 2;
  r.saddle_part = 0.01;
  r.plateau_window = 12;
  r.plateau_steps = 1000;
  r.decrement = 1e-12;
  r.max_iterations = 7;
  return r;
}

constexpr const char* kNotAsPromised =
    "the energy does not fall as its derivatives promise: it is not smooth there, they are wrong, "
    "or "
    "its Hessian is nearly singular";

void expect_goes_on(const Advice& advice) {
  EXPECT_FALSE(advice.stop.has_value()) << advice.stop->message;
}

void expect_stop(const Advice& advice, Status status, const std::string& message) {
  ASSERT_TRUE(advice.stop.has_value());
  EXPECT_EQ(status_name(advice.stop->status), status_name(status));
  EXPECT_EQ(advice.stop->message, message);
}

TEST(Stopping, StepsWithProgressGoOnUntilTheIterationsAreUsedUp) {
  StoppingTest test(rules(), 100);
  for (int k = 0; k < 7; ++k) {
    EXPECT_FALSE(test.before_step().has_value()) << k;
    const Advice advice = test.after(moved(0.1, 0.2));
    expect_goes_on(advice);
    EXPECT_TRUE(advice.anchor);
    EXPECT_FALSE(advice.polish);
  }
  ASSERT_TRUE(test.before_step().has_value());
  EXPECT_EQ(test.before_step()->status, Status::MaxIterations);
  EXPECT_FALSE(test.before_step()->at_anchor);
}

TEST(Stopping, ASmallStepNearAMinimumIsPolishedOnceThenConverged) {
  StoppingTest test(rules(), 100);
  const Advice first = test.after(moved(9e-7, 9e-6));
  expect_goes_on(first);
  EXPECT_TRUE(first.polish);
  expect_goes_on(test.after(moved(0.1, 0.2)));  // a polish remembered is not asked for again
  expect_stop(test.after(moved(9e-7, 9e-6)), Status::Converged, "relative decrease");
}

TEST(Stopping, TheTailHasAsManySmallStepsAsAsked) {
  for (const int steps : {1, 2, 4}) {
    StoppingRules patient = rules();
    patient.tail_steps = steps;
    patient.stall_iterations = 100;
    StoppingTest test(patient, 100);
    double decrease = 9e-7;  // each a tenth of the last: no plateau
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
    StoppingTest test(rules(), 100);
    EXPECT_FALSE(test.after(moved(9e-7, 1.1e-5)).polish) << "decrement too large";
  }
  StoppingTest test(rules(), 100);
  const Advice exact = test.after(moved(9e-7, 9e-6, 1, Curvature::Exact));
  EXPECT_FALSE(exact.polish) << "exact steps end by the decrement rule";
  expect_goes_on(exact);
}

TEST(Stopping, ASmallStepBeforeAChangeOfTheProblemIsNoSignOfAMinimum) {
  StoppingTest test(rules(), 100);
  for (int k = 0; k < 2; ++k) {
    const Advice advice = test.after(moved(9e-7, 9e-6), Since::ProblemChanged);
    EXPECT_FALSE(advice.polish);
    expect_goes_on(advice);
  }
  // but it does not go on like that for ever
  expect_stop(test.after(moved(9e-7, 9e-6), Since::ProblemChanged), Status::Converged,
              "relative decrease");
}

TEST(Stopping, AStepThatIsHeldHasFurtherTriesWhereTheProblemChanges) {
  for (const auto outcome : {StepResult::Outcome::Blocked, StepResult::Outcome::NoDecrease}) {
    StepResult held = moved(0, 1e-2);
    held.outcome = outcome;
    StoppingTest test(rules(), 100);
    for (int k = 0; k < 3; ++k) expect_goes_on(test.after(held, Since::ProblemChanged));
    expect_stop(test.after(held, Since::ProblemChanged), Status::Stalled, kNotAsPromised);
    StoppingTest same(rules(), 100);
    expect_stop(same.after(held), Status::Stalled, kNotAsPromised);
  }
}

TEST(Stopping, IdleStepsInARowStallFarFromAMinimumAndReturnToTheAnchor) {
  StoppingTest test(rules(), 100);
  EXPECT_FALSE(test.after(moved(9e-7, 1e-2)).anchor);
  EXPECT_FALSE(test.after(moved(0.1, 1e-2, 9e-4)).anchor) << "a certified step below stall_step";
  expect_goes_on(test.after(moved(0.1, 1e-2)));  // the row is broken
  expect_goes_on(test.after(moved(9e-7, 1e-2)));
  expect_goes_on(test.after(moved(0.1, 1e-2, 9e-4)));
  const Advice last = test.after(moved(9e-7, 1e-2));
  expect_stop(last, Status::Stalled, "held at the limit of the feasible set");
  EXPECT_TRUE(last.stop->at_anchor);
}

// What shortened the idle steps is named, the feasible set before the domain; progress in between
// makes it forgotten.
TEST(Stopping, AStallIsToldForWhatHeldTheSteps) {
  const auto message_of = [](std::initializer_list<StepLimit> limits) {
    StoppingTest test(rules(), 100);
    Advice advice;
    for (const StepLimit limit : limits) {
      StepResult step = moved(9e-7, 1e-2);
      step.limit = limit;
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
    StoppingTest test(rules(), 100);
    StepResult step = moved(9e-7, 1e-2);
    step.limit = Checker;
    expect_goes_on(test.after(step));
    expect_goes_on(test.after(moved(0.1, 1e-2)));
    step = ended(Outcome::NoDecrease, 1e-2);
    step.limit = limit;
    expect_stop(test.after(step), Status::Stalled, message);
  }
}

TEST(Stopping, IdleStepsNearAMinimumConvergeWhereTheyAre) {
  StoppingTest test(rules(), 100);
  expect_goes_on(test.after(moved(9e-7, 9e-5)));
  expect_goes_on(test.after(moved(4e-7, 9e-5)));
  const Advice last = test.after(moved(1e-7, 9e-5));
  expect_stop(last, Status::Converged, "relative decrease");
  EXPECT_FALSE(last.stop->at_anchor);
}

TEST(Stopping, OnlyAGoodPartOfAStepMakesAnAnchor) {
  StoppingTest test(rules(), 100);
  EXPECT_TRUE(test.after(moved(0.1, 0.2, 0.1)).anchor);
  EXPECT_FALSE(test.after(moved(0.1, 0.2, 0.09)).anchor);
}

TEST(Stopping, AStepThatDidNotMoveEndsTheRun) {
  const auto answer = [](const StepResult& step) { return StoppingTest(rules(), 100).after(step); };
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

// Decrements are compared with the energy before the step, never with less than 1e-14 of the first.
TEST(Stopping, EnergiesThatVanishHaveTheScaleOfTheirStart) {
  const auto blocked_at = [](double energy, double first) {
    StepResult step = ended(Outcome::Blocked, 0);
    step.energy_before = energy;
    step.record.newton_decrement = 1e-19;
    return StoppingTest(rules(), first).after(step).stop->status;
  };
  EXPECT_EQ(blocked_at(0, 1), Status::Converged);      // 1e-19 <= 1e-4 * 1e-14
  EXPECT_EQ(blocked_at(0, 1e-2), Status::Stalled);     // 1e-19 > 1e-4 * 1e-16
  EXPECT_EQ(blocked_at(-1e-2, 0), Status::Converged);  // sizes count, not signs
}

TEST(Stopping, BriefRulesEndWithTheFirstSmallStep) {
  StoppingTest test(brief_rules(3, 1e-2), 100);
  expect_goes_on(test.after(moved(0.1, 0.2, 1e-9)));  // however short
  const Advice small = test.after(moved(9e-3, 0.2));
  expect_stop(small, Status::Converged, "relative decrease");

  StoppingTest limited(brief_rules(2, -std::numeric_limits<double>::infinity()), 100);
  expect_goes_on(limited.after(moved(0, 0)));
  expect_goes_on(limited.after(moved(0, 0)));
  EXPECT_TRUE(limited.before_step().has_value());
}

// Decreases that stay as they are, whatever the decrement says: 1000 times 9e-7 may be left.
TEST(Stopping, APlateauIsNoMinimum) {
  StoppingRules patient = rules();
  patient.max_iterations = 1000;
  StoppingTest test(patient, 100);
  EXPECT_TRUE(test.after(moved(0.1, 0.2)).anchor);
  int polished = 0;
  for (int k = 0; k < 300; ++k) {
    const Advice advice = test.after(moved(9e-7, 9e-6));
    expect_goes_on(advice);
    polished += advice.polish;
  }
  EXPECT_EQ(polished, 1);
}

// Decreases 1e-6 r, 1e-6 r^2 ... from step 24 on: r^k / (1 - r) r, and 2e-6 may be left.
TEST(Stopping, WhatIsLeftIsForeseenFromTheRateOfDecreases) {
  const auto small_steps = [](double rate) {
    StoppingRules patient = rules();
    patient.max_iterations = 1000;
    StoppingTest test(patient, 100);
    for (int k = 24; k > 0; --k) expect_goes_on(test.after(moved(1e-6 / std::pow(rate, k), 1e-2)));
    for (int k = 1; k < 100; ++k)
      if (test.after(moved(1e-6 * std::pow(rate, k), 9e-6)).stop) return k;
    return -1;
  };
  EXPECT_EQ(small_steps(0.5), 2) << "the first is polished";
  EXPECT_EQ(small_steps(0.8), 4);    // 0.8^k * 4 <= 2
  EXPECT_EQ(small_steps(0.95), 44);  // 0.95^k * 19 <= 2
}

// The same decreases end a run three steps after the last Hessian that was indefinite.
TEST(Stopping, IndefiniteHessiansAskForMore) {
  const auto last_of = [](int indefinite) {
    StoppingTest test(rules(), 100);
    const double decreases[] = {0.1, 1e-3, 1e-5, 9e-7, 3e-7, 1e-7};
    Advice advice;
    for (int k = 0; k < 6; ++k) {
      StepResult step = moved(decreases[k], 5e-5);
      step.record.failed_factorizations = k == indefinite;
      advice = test.after(step);
    }
    return advice;
  };
  expect_stop(last_of(2), Status::Converged, "relative decrease");
  expect_goes_on(last_of(3));
}

// Every other decrease is small: 12 of them say what one does not.
TEST(Stopping, DecreasesThatAlternateAreAPlateau) {
  StoppingRules patient = rules();
  patient.max_iterations = 1000;
  StoppingTest test(patient, 100);
  for (int k = 0; k < 24; ++k) expect_goes_on(test.after(moved(1.1e-6, 9e-6)));
  for (int k = 0; k < 100; ++k) {
    const Advice advice = test.after(moved(k % 2 == 0 ? 9e-7 : 1e-7, 9e-6));
    ASSERT_FALSE(advice.stop.has_value()) << k;
  }
}

// A saddle: the decreases fell, and begin to grow.
TEST(Stopping, DecreasesThatGrowAreNoMinimum) {
  const auto last_of = [](double decrease) {
    StoppingTest test(rules(), 100);
    for (const double d : {0.1, 1e-3, 1e-5, 4e-7, 2e-7}) expect_goes_on(test.after(moved(d, 5e-5)));
    return test.after(moved(decrease, 5e-5));
  };
  expect_goes_on(last_of(2.1e-7));
  expect_stop(last_of(1e-7), Status::Converged, "relative decrease");
}

TEST(Stopping, DecreasesThatNoEnergyCanTellAreNone) {
  StoppingRules strict = rules();
  strict.relative_decrease = 1e-14;
  StoppingTest test(strict, 100);
  for (int k = 0; k < 2; ++k) expect_goes_on(test.after(moved(9e-15, 9e-5)));
  expect_stop(test.after(moved(9e-15, 9e-5)), Status::Converged, "relative decrease");
}

TEST(Stopping, WhatTheCertificateHoldsBackIsNoPlateau) {
  StoppingRules patient = rules();
  patient.max_iterations = 1000;
  StoppingTest test(patient, 100);
  for (int k = 0; k < 20; ++k) test.after(moved(2e-6, 9e-5));
  for (int k = 0; k < 2; ++k) expect_goes_on(test.after(moved(9e-7, 9e-5, 9e-4)));
  expect_stop(test.after(moved(9e-7, 9e-5, 9e-4)), Status::Converged, "relative decrease");

  StoppingTest free(patient, 100);
  for (int k = 0; k < 20; ++k) free.after(moved(2e-6, 9e-5));
  for (int k = 0; k < 20; ++k) expect_goes_on(free.after(moved(9e-7, 9e-5)));
}

// The loop of Stepper::minimize obeys the test: from within a bound that lets nothing through, the
// result is the anchor.
TEST(Stopping, MinimizeReturnsToTheAnchor) {
  const auto well = std::make_shared<const Chain>(1, parabola(5, 1));
  // The wall at 1 lets a tenth of the way to it pass, then less and less.
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
  NewtonStepper stepper(builder.build(), options);
  std::vector<double> points;
  const SolveResult r = stepper.minimize(Vec::Zero(1), StoppingRules{},
                                         [&](const IterationRecord& record, const Vec& y) {
                                           if (record.step_bound >= 0.1) points.push_back(y[0]);
                                           return Directive::Continue;
                                         });
  EXPECT_EQ(r.status, Status::Stalled) << r.message;
  ASSERT_FALSE(points.empty());
  EXPECT_EQ(r.y[0], points.back());
  EXPECT_GT(r.iterations.size(), points.size());
}

}  // namespace
}  // namespace majorant::test

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
