#include "majorant/quads/internal/quad_attempts.h"

#include <gtest/gtest.h>

#include <vector>

namespace majorant {
namespace {

std::vector<double> factors_of(const std::vector<QuadAttempt>& attempts) {
  std::vector<double> factors;
  for (const QuadAttempt& attempt : attempts) factors.push_back(attempt.factor);
  return factors;
}

TEST(QuadAttempts, TheRequestedCountComesFirstWithZeroLengthArcs) {
  const std::vector<QuadAttempt> attempts = close_attempts();
  EXPECT_EQ(factors_of(attempts), (std::vector<double>{1, 1.02, 0.98, 1.04, 1, 1.03}));
  for (std::size_t k = 0; k < attempts.size(); ++k) {
    EXPECT_EQ(attempts[k].lengths, k < 4 ? ArcLengths::NonNegative : ArcLengths::Positive);
    EXPECT_EQ(attempts[k].purpose, AttemptPurpose::Close);
  }
}

TEST(QuadAttempts, GrowUpToFourTimesOr200Quads) {
  EXPECT_EQ(factors_of(growing_attempts(4000)), (std::vector<double>{1.5, 2.25, 3.375}));
  const std::vector<double> few = factors_of(growing_attempts(10));
  EXPECT_LE(few.back(), 20);
  EXPECT_GT(1.5 * few.back(), 20);
}

TEST(QuadAttempts, DoubleFromThereOnUpTo20000Quads) {
  const std::vector<QuadAttempt> attempts = doubling_attempts(100, AttemptPurpose::Last);
  EXPECT_EQ(factors_of(attempts), (std::vector<double>{8, 16, 32, 64, 128}));
  for (const QuadAttempt& attempt : attempts) EXPECT_EQ(attempt.purpose, AttemptPurpose::Last);
  EXPECT_TRUE(doubling_attempts(4000, AttemptPurpose::Suggested).empty());
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
