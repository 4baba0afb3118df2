#include "majorant/mesh/index_lists.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "expected_error.h"
#include "mesh/list_edits.h"

namespace majorant {
namespace {

using Vectors = std::vector<std::vector<Index>>;

// An assignment to a span would not change the lists.
static_assert(!std::is_assignable_v<decltype(std::declval<IndexLists&>()[0]), std::span<Index>>);
static_assert(
    !std::is_assignable_v<decltype(std::declval<IndexLists&>().back()), std::span<Index>>);

TEST(IndexLists, HoldListsOfAnyLength) {
  IndexLists lists = {{0, 1, 2}, {}, {5, 4, 3, 2}};
  EXPECT_EQ(lists.size(), 3u);
  EXPECT_EQ(vectors_of(lists), (Vectors{{0, 1, 2}, {}, {5, 4, 3, 2}}));
  EXPECT_EQ(lists[2][1], 4);
  EXPECT_TRUE(lists[1].empty());
  EXPECT_EQ(lists, IndexLists(vectors_of(lists)));
  EXPECT_NE(lists, (IndexLists{{0, 1, 2}, {5, 4, 3, 2}}));
  EXPECT_NE(lists, (IndexLists{{0, 1}, {2}, {5, 4, 3, 2}}));  // the same indices in other lists
  for (const auto list : lists) std::reverse(list.begin(), list.end());
  lists[0][0] = 9;
  lists.back()[3] = 8;
  EXPECT_EQ(vectors_of(lists), (Vectors{{9, 1, 0}, {}, {2, 3, 4, 8}}));
  const std::span<const Index> all = std::as_const(lists).indices();
  EXPECT_EQ(std::vector<Index>(all.begin(), all.end()), (std::vector<Index>{9, 1, 0, 2, 3, 4, 8}));
}

TEST(IndexLists, MayBeEmptyOrHoldEmptyLists) {
  IndexLists lists;
  EXPECT_TRUE(lists.empty());
  EXPECT_TRUE(lists.begin() == lists.end());
  lists.resize(2);
  EXPECT_EQ(vectors_of(lists), (Vectors{{}, {}}));
  EXPECT_EQ(lists, (IndexLists{{}, {}}));
  EXPECT_TRUE(lists.indices().empty());
  const IndexLists moved = std::move(lists);
  EXPECT_EQ(moved.size(), 2u);
  lists = {{1}};  // NOLINT: used after the move
  EXPECT_EQ(vectors_of(lists), (Vectors{{1}}));
}

TEST(IndexLists, TakeOwnListsAndThemselves) {
  IndexLists lists = {{0, 1, 2}, {3, 4}};
  for (int k = 0; k < 20; ++k) lists.push_back(lists[0]);  // with some reallocations
  ASSERT_EQ(lists.size(), 22u);
  for (std::size_t k = 2; k < 22; ++k)
    EXPECT_EQ(vectors_of(lists)[k], (std::vector<Index>{0, 1, 2})) << k;
  IndexLists twice = {{0, 1, 2}, {}, {3, 4}};
  twice.append(twice);
  EXPECT_EQ(vectors_of(twice), (Vectors{{0, 1, 2}, {}, {3, 4}, {0, 1, 2}, {}, {3, 4}}));
  twice.append({});
  EXPECT_EQ(twice.size(), 6u);
}

TEST(IndexLists, AreResizedAtTheirEnd) {
  IndexLists lists = {{0, 1, 2}, {3, 4}, {5}};
  lists.resize(1);
  EXPECT_EQ(lists, (IndexLists{{0, 1, 2}}));
  lists.resize(3);
  lists.push_back({7, 8});
  EXPECT_EQ(lists, (IndexLists{{0, 1, 2}, {}, {}, {7, 8}}));
  lists.clear();
  EXPECT_EQ(lists, IndexLists());
}

TEST(IndexLists, RefuseMoreIndicesThanAreCounted) {
  IndexLists lists = {{0, 1, 2}};
  const Index one = 0;
  const std::span<const Index> many(&one, std::numeric_limits<Index>::max());  // no entry is read
  expect_contains(error_message(ErrorKind::Unsupported, [&] { lists.push_back(many); }),
                  {"indices in lists", "2147483650 are more than the 2147483647"});
  EXPECT_EQ(lists, (IndexLists{{0, 1, 2}}));
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
