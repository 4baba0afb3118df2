// Compares sorting pairs by counting with std::sort and std::map.
#include "majorant/framework/pair_order.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "majorant/framework/parallel.h"

namespace majorant {
namespace {

using Pairs = std::vector<std::pair<Index, Index>>;

Pairs random_pairs(Index count, Index firsts, Index seconds, unsigned seed) {
  std::mt19937 random(seed);
  Pairs pairs;
  for (Index k = 0; k < count; ++k)
    pairs.emplace_back(static_cast<Index>(random() % static_cast<unsigned>(firsts)),
                       static_cast<Index>(random() % static_cast<unsigned>(seconds)));
  return pairs;
}

TEST(PairOrder, RunsAreThoseOfAMap) {
  for (const auto& [count, firsts, seconds] :
       {std::array{0, 1, 1}, {1, 1, 1}, {500, 3, 7}, {3000, 1000, 4}, {20000, 9000, 9000}}) {
    const Pairs pairs = random_pairs(count, firsts, seconds, 7);
    std::map<std::pair<Index, Index>, std::vector<Index>> expected;
    for (Index k = 0; k < count; ++k)
      if (pairs[k].second % 5 != 4) expected[pairs[k]].push_back(k);
    for (const int threads : {1, 3}) {
      const ThreadCount some(threads);
      const PairOrder order(firsts, count, [&](Index k) {
        return pairs[k].second % 5 != 4 ? pairs[k] : std::pair<Index, Index>(-1, 0);
      });
      auto next = expected.begin();
      order.for_each_run([&](std::span<const PairOrder::Entry> run) {
        ASSERT_NE(next, expected.end());
        std::vector<Index> numbers;
        for (const auto& [second, number] : run) {
          EXPECT_EQ(second, next->first.second);
          numbers.push_back(number);
        }
        EXPECT_EQ(numbers, next->second);
        EXPECT_EQ(order.find(next->first.first, next->first.second), next->second.front());
        ++next;
      });
      EXPECT_EQ(next, expected.end());
      if (count > 0) {
        EXPECT_EQ(order.find(firsts - 1, seconds), -1);
      }
    }
  }
}

TEST(PairOrder, PairsAreNumberedAsTheyCome) {
  const Pairs pairs = random_pairs(5000, 80, 30, 3);
  std::map<std::pair<Index, Index>, Index> expected;
  const NumberedPairs numbered = numbered_in_order(80, 5000, [&](Index k) { return pairs[k]; });
  for (Index k = 0; k < 5000; ++k) {
    const auto [entry, is_new] = expected.emplace(pairs[k], static_cast<Index>(expected.size()));
    EXPECT_EQ(numbered.number[k], entry->second);
    if (is_new) {
      EXPECT_EQ(numbered.first[entry->second], k);
    }
  }
  EXPECT_EQ(numbered.first.size(), expected.size());
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
