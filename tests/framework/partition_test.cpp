// Unknowns that several ranks share: their owners, messages, sums.
#include "majorant/framework/partition.h"

#include <gtest/gtest.h>

#include "expected_error.h"
#include "framework/thread_ranks.h"

namespace majorant {
namespace {

// Returns a line of unknowns, five per rank. The last unknown of a rank is the first one of the
// next rank; the lower rank owns it.
Partition line(const std::shared_ptr<const Ranks>& ranks) {
  std::vector<Partition::Neighbour> neighbours;
  if (ranks->rank() > 0) neighbours.push_back({ranks->rank() - 1, {}, {0}});
  if (ranks->rank() + 1 < ranks->count()) neighbours.push_back({ranks->rank() + 1, {4}, {}});
  return {ranks, 5, std::move(neighbours)};
}

TEST(Partition, OneProcessOwnsAll) {
  const Partition all(3);
  EXPECT_TRUE(all.is_whole());
  EXPECT_EQ(all.owned_size(), 3);
  EXPECT_EQ(all.global(2), 2);
  Vec g = Vec::LinSpaced(3, 1, 3);
  all.add_to_owners(g);
  all.copy_from_owners(g);
  EXPECT_EQ(g, Vec(Vec::LinSpaced(3, 1, 3)));
  EXPECT_EQ(all.dot(g, g), 14);
}

TEST(Partition, NumbersOwnersRankByRank) {
  test::run_ranks(3, [](const auto& ranks) {
    const Partition p = line(ranks);
    EXPECT_FALSE(p.is_whole());
    EXPECT_EQ(p.global_size(), 13);
    const Index first = ranks->rank() == 0 ? 0 : 1;
    EXPECT_EQ(p.owned_size(), 5 - first);
    for (Index i = 0; i < 5; ++i) EXPECT_EQ(p.global(i), 4 * ranks->rank() + i);
  });
}

TEST(Partition, AddsToOwnersAndCopiesBack) {
  test::run_ranks(3, [](const auto& ranks) {
    const Partition p = line(ranks);
    Vec g = Vec::Ones(5);
    p.add_to_owners(g);
    EXPECT_EQ(g[0], ranks->rank() == 0 ? 1 : 0);
    EXPECT_EQ(g[4], ranks->rank() == 2 ? 1 : 2);
    EXPECT_EQ(p.squared_norm(g), 2 * 4 + 11);
    p.copy_from_owners(g);
    EXPECT_EQ(g[0], ranks->rank() == 0 ? 1 : 2);
    EXPECT_EQ(p.squared_norm(g), 2 * 4 + 11);
  });
}

// Rank 0 has unknown 0 also as its number 2, rank 1 as its number 0.
TEST(Partition, ARankMayHaveCopiesOfItsOwn) {
  test::run_ranks(2, [](const auto& ranks) {
    const bool first = ranks->rank() == 0;
    const Partition p = first ? Partition(ranks, 3, {{0, {0}, {2}}, {1, {0}, {}}})
                              : Partition(ranks, 1, {{0, {}, {0}}});
    EXPECT_EQ(p.global_size(), 2);
    Vec g = Vec::Constant(p.size(), 1);
    p.add_to_owners(g);
    if (first) {
      EXPECT_EQ(g, Vec(Eigen::Vector3d(3, 1, 0)));
    }
    p.copy_from_owners(g);
    EXPECT_EQ(g[first ? 2 : 0], 3);
    EXPECT_EQ(p.global(first ? 2 : 0), 0);
  });
}

TEST(Partition, KeepsAPartOfTheUnknowns) {
  test::run_ranks(2, [](const auto& ranks) {
    const Partition p = line(ranks).part({0, 2, 4});
    EXPECT_EQ(p.global_size(), 5);
    Vec y = Vec::Constant(3, ranks->rank());
    p.copy_from_owners(y);
    EXPECT_EQ(y[0], 0);
    EXPECT_EQ(p.global(0), ranks->rank() == 0 ? 0 : 2);
  });
}

TEST(Partition, RefusesPartsThatRanksDoNotAgreeOn) {
  const auto disagree = [](const auto& ranks) {
    line(ranks).part(ranks->rank() == 0 ? std::vector<Index>{0, 1} : std::vector<Index>{0, 1, 2});
  };
  EXPECT_THROW(test::run_ranks(2, disagree), InvalidArgument);
}

TEST(Partition, RefusesUnknownsWithTwoOwners) {
  EXPECT_THROW(Partition(one_process(), 3, {{0, {0, 1}, {2, 2}}}), InvalidArgument);
  EXPECT_THROW(Partition(one_process(), 3, {{0, {2}, {2}}}), InvalidArgument);
  EXPECT_THROW(Partition(one_process(), 3, {{1, {2}, {}}}), InvalidArgument);
  EXPECT_THROW(Partition(one_process(), 3, {{0, {3}, {1}}}), InvalidArgument);
}

TEST(Partition, SumsAreMadeInTheOrderOfRanks) {
  test::run_ranks(3, [](const auto& ranks) {
    const std::vector<double> parts{1e16, 1, -1e16};
    EXPECT_EQ(ranks->sum(parts[static_cast<std::size_t>(ranks->rank())]), (1e16 + 1) - 1e16);
    EXPECT_EQ(ranks->max(ranks->rank()), 2);
    EXPECT_FALSE(ranks->all(ranks->rank() != 1));
    EXPECT_TRUE(ranks->any(ranks->rank() == 1));
    EXPECT_EQ(ranks->of_first(ranks->rank() + 7), 7);
  });
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
