// The steps that backtrack() tries, and its results.
#include "majorant/framework/backtracking.h"

#include <gtest/gtest.h>

#include <vector>

namespace majorant {
namespace {

struct Tried {
  std::vector<double> steps;
  std::optional<double> taken;
};

// Accepts steps up to `good`; shortens others by `part`.
Tried search(double first, const Backtracking& rules, double good, double part = kHalve) {
  Tried tried;
  tried.taken = backtrack(first, rules, [&](double step) {
    tried.steps.push_back(step);
    return step <= good ? kTake : part;
  });
  return tried;
}

TEST(Backtracking, TakesTheFirstGoodStep) {
  const Tried tried = search(3, {}, 0.5);
  EXPECT_EQ(tried.steps, (std::vector<double>{3, 1.5, 0.75, 0.375}));
  EXPECT_EQ(tried.taken, 0.375);
  EXPECT_EQ(search(3, {}, 3).steps.size(), 1u);
}

TEST(Backtracking, ShortensByTheFactorOfTheAttempt) {
  const Tried tried = search(1, {}, 0.1, 0.25);
  EXPECT_EQ(tried.steps, (std::vector<double>{1, 0.25, 0.0625}));
  EXPECT_EQ(tried.taken, 0.0625);
}

TEST(Backtracking, EndsBelowTheSmallestStep) {
  const Tried tried = search(1, {.smallest = 0.25}, 0.1);
  EXPECT_EQ(tried.steps, (std::vector<double>{1, 0.5, 0.25}));
  EXPECT_FALSE(tried.taken);
}

TEST(Backtracking, EndsAfterTheLastTrial) {
  const Tried tried = search(1, {.most_trials = 2}, 0.25);
  EXPECT_EQ(tried.steps, (std::vector<double>{1, 0.5}));
  EXPECT_FALSE(tried.taken);
}

TEST(Backtracking, EndsIfTheAttemptGivesUp) {
  const Tried tried = search(1, {}, 0.1, kGiveUp);
  EXPECT_EQ(tried.steps, (std::vector<double>{1}));
  EXPECT_FALSE(tried.taken);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
