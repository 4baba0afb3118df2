// A pattern from positions of entries in any order, with repetitions.
#include "majorant/framework/pattern_of_pairs.h"

#include <gtest/gtest.h>

namespace majorant {
namespace {

TEST(PatternOfPairs, EitherTriangleOnceAndTheDiagonal) {
  const SparsePattern pattern = pattern_of_pairs(4, 2, [](const auto& add) {
    add(0, 2);
    add(2, 0);
    add(3, 2);
    add(1, 1);
    add(3, 0);
  });
  require_valid(pattern);
  EXPECT_EQ(pattern.column_starts, (std::vector<Index>{0, 3, 4, 6, 7}));
  EXPECT_EQ(pattern.rows, (std::vector<Index>{0, 2, 3, 1, 2, 3, 3}));
  EXPECT_EQ(pattern.block_of, (std::vector<Index>{0, 0, 1, 1}));
}

TEST(PatternOfPairs, OfNothing) {
  const SparsePattern pattern = pattern_of_pairs(2, 1, [](const auto&) {});
  EXPECT_EQ(pattern.rows, (std::vector<Index>{0, 1}));
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
