// The remaining decrease of the energy that stopping rules predict: plateaus, decrements, saddles.
#include <gtest/gtest.h>

#include <cmath>

#include "framework/step_reports.h"

namespace majorant::test {
namespace {

using Since = StoppingTest::Since;

// The predicted decrease of the next step counts, even after small steps.
TEST(WhatIsLeft, TheLastStepPromisesLittle) {
  StoppingRules strict = usual_rules();
  strict.last_factor = 0.1;
  strict.max_iterations = 1000;
  StoppingTest test(strict, 100);
  double decrease = 9e-7;
  for (int k = 0; k < 4;
       ++k, decrease /= 10) {  // each is a tenth of the last one, hence no plateau
    const Advice advice = test.after(moved(decrease, 1.1e-7));
    expect_goes_on(advice);
    EXPECT_EQ(advice.polish, k == 0);
  }
  expect_stop(test.after(moved(decrease, 0.9e-7)), Status::Converged, "relative decrease");
}

// If the energy resolves no decrease, or the certificate blocks steps, the predicted decrease is
// not awaited, and the message does not claim it.
TEST(WhatIsLeft, PromisesAreAwaitedWhileTheEnergyFalls) {
  StoppingRules strict = usual_rules();
  strict.last_factor = 0.1;
  strict.max_iterations = 1000;
  const auto end_of = [&](double decrease, double bound, Since since) {
    StoppingTest test(strict, 100);
    expect_goes_on(test.after(moved(0.1, 0.2)));
    for (int k = 0; k < 2; ++k) expect_goes_on(test.after(moved(decrease, 9e-5, bound), since));
    return test.after(moved(decrease, 9e-5, bound), since);
  };
  expect_goes_on(end_of(1.1e-12, 1, Since::Same));
  expect_stop(end_of(0.9e-12, 1, Since::Same), Status::Converged, "no further decrease");
  expect_stop(end_of(0, 1, Since::ProblemChanged), Status::Converged, "no further decrease");
  expect_stop(end_of(9e-7, 9e-4, Since::Same), Status::Converged,
              "near a minimum, held at the limit of the feasible set");
}

// The decreases do not fall: 1000 times 9e-7 may remain, independently of the decrement.
TEST(WhatIsLeft, APlateauIsNoMinimum) {
  StoppingRules patient = usual_rules();
  patient.max_iterations = 1000;
  StoppingTest test(patient, 100);
  EXPECT_TRUE(test.after(moved(0.1, 0.2)).fallback);
  int polished = 0;
  for (int k = 0; k < 300; ++k) {
    const Advice advice = test.after(moved(9e-7, 9e-6));
    expect_goes_on(advice);
    polished += advice.polish;
  }
  EXPECT_EQ(polished, 1);
}

// Decreases 1e-6 r, 1e-6 r^2 ... from step 24 on: r^k / (1 - r) r, and 2e-6 may remain.
TEST(WhatIsLeft, IsPredictedFromTheRateOfDecreases) {
  const auto small_steps = [](double rate) {
    StoppingRules patient = usual_rules();
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

// These decreases end a run three steps after the last indefinite Hessian.
TEST(WhatIsLeft, IndefiniteHessiansNeedMoreSteps) {
  const auto last_of = [](int indefinite) {
    StoppingTest test(usual_rules(), 100);
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

// Every other decrease is small: 12 of them show a plateau, one does not.
TEST(WhatIsLeft, DecreasesThatAlternateAreAPlateau) {
  StoppingRules patient = usual_rules();
  patient.max_iterations = 1000;
  StoppingTest test(patient, 100);
  for (int k = 0; k < 24; ++k) expect_goes_on(test.after(moved(1.1e-6, 9e-6)));
  for (int k = 0; k < 100; ++k) {
    const Advice advice = test.after(moved(k % 2 == 0 ? 9e-7 : 1e-7, 9e-6));
    ASSERT_FALSE(advice.stop.has_value()) << k;
  }
}

// At a saddle, decreases first fall and then grow.
TEST(WhatIsLeft, DecreasesThatGrowAreNoMinimum) {
  const auto last_of = [](double decrease) {
    StoppingTest test(usual_rules(), 100);
    for (const double d : {0.1, 1e-3, 1e-5, 4e-7, 2e-7}) expect_goes_on(test.after(moved(d, 5e-5)));
    return test.after(moved(decrease, 5e-5));
  };
  expect_goes_on(last_of(2.1e-7));
  expect_stop(last_of(1e-7), Status::Converged, "relative decrease");
}

TEST(WhatIsLeft, DecreasesBelowRoundingAreNone) {
  StoppingRules strict = usual_rules();
  strict.relative_decrease = 1e-14;
  StoppingTest test(strict, 100);
  for (int k = 0; k < 2; ++k) expect_goes_on(test.after(moved(9e-15, 9e-5)));
  expect_stop(test.after(moved(9e-15, 9e-5)), Status::Converged, "relative decrease");
}

TEST(WhatIsLeft, StepsLimitedByTheCertificateAreNoPlateau) {
  StoppingRules patient = usual_rules();
  patient.max_iterations = 1000;
  StoppingTest test(patient, 100);
  for (int k = 0; k < 20; ++k) test.after(moved(2e-6, 9e-5));
  for (int k = 0; k < 2; ++k) expect_goes_on(test.after(moved(9e-7, 9e-5, 9e-4)));
  expect_stop(test.after(moved(9e-7, 9e-5, 9e-4)), Status::Converged, "relative decrease");

  StoppingTest free(patient, 100);
  for (int k = 0; k < 20; ++k) free.after(moved(2e-6, 9e-5));
  for (int k = 0; k < 20; ++k) expect_goes_on(free.after(moved(9e-7, 9e-5)));
}

}  // namespace
}  // namespace majorant::test

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
