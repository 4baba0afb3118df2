// Sets of a union-find equal those of a search over the joined pairs, with their smallest member as
// name.
#include "majorant/mesh/union_find.h"

#include <gtest/gtest.h>

#include <random>
#include <utility>

namespace majorant {
namespace {

TEST(UnionFind, StartsApart) {
  UnionFind sets(3);
  for (Index i = 0; i < 3; ++i) EXPECT_EQ(sets.find(i), i);
}

TEST(UnionFind, ReturnsWhetherTwoSetsWereJoined) {
  UnionFind sets(5);
  EXPECT_TRUE(sets.join(4, 2));
  EXPECT_TRUE(sets.join(3, 1));
  EXPECT_FALSE(sets.join(1, 3));
  EXPECT_FALSE(sets.join(2, 2));
  EXPECT_TRUE(sets.join(3, 4));
  EXPECT_FALSE(sets.join(1, 2));
  EXPECT_EQ(sets.find(0), 0);
  for (Index i = 1; i < 5; ++i) EXPECT_EQ(sets.find(i), 1) << i;
}

TEST(UnionFind, AgreesWithRelabelling) {
  std::mt19937 random(3);
  for (const Index count : {1, 2, 10, 60, 400}) {
    UnionFind sets(count);
    std::vector<Index> label(to_size(count));
    std::iota(label.begin(), label.end(), 0);
    for (Index pair = 0; pair < count; ++pair) {
      const auto i = static_cast<Index>(random() % to_size(count));
      const auto k = static_cast<Index>(random() % to_size(count));
      const auto [small, large] = std::minmax({label[i], label[k]});
      EXPECT_EQ(sets.join(i, k), small != large);
      std::replace(label.begin(), label.end(), Index(large), Index(small));
    }
    for (Index i = 0; i < count; ++i) ASSERT_EQ(sets.find(i), label[i]) << count << ": " << i;
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
