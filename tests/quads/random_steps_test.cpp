#include "majorant/quads/internal/random_steps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace majorant {
namespace {

std::vector<std::int64_t> drawn(std::int64_t least, std::int64_t most, int count) {
  std::mt19937 random(1);
  std::vector<std::int64_t> numbers;
  for (int i = 0; i < count; ++i) numbers.push_back(random_between(random, least, most));
  return numbers;
}

// The numbers are those of std::mt19937, which is equal in every standard library.
TEST(RandomSteps, AreTheSameEverywhere) {
  EXPECT_EQ(drawn(-1000, 1000, 6), (std::vector<std::int64_t>{-166, 995, 441, 866, -1000, -744}));
  EXPECT_EQ(drawn(1, 64, 6), (std::vector<std::int64_t>{27, 64, 47, 60, 1, 9}));
  EXPECT_EQ(drawn(0, 3000000000, 6), (std::vector<std::int64_t>{1251065995, 2991554425, 2160973468,
                                                                2797672084, 384373343, 906997703}));
}

TEST(RandomSteps, AreEven) {
  constexpr int kDraws = 100000;
  for (const std::int64_t most : {0, 1, 2, 6}) {
    const std::vector<std::int64_t> numbers = drawn(0, most, kDraws);
    const double expected = kDraws / static_cast<double>(most + 1);
    for (std::int64_t k = 0; k <= most; ++k)
      EXPECT_NEAR(static_cast<double>(std::count(numbers.begin(), numbers.end(), k)), expected,
                  0.03 * expected);
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
