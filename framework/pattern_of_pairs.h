// The pattern of a symmetric matrix from the places of its entries.
//
//   const SparsePattern pattern = pattern_of_pairs(3, 1, [](const auto& add) {
//     add(0, 1);
//     add(2, 1);
//   });
#pragma once

#include <algorithm>
#include <vector>

#include "majorant/framework/linear_solver.h"

namespace majorant {

// each(add) calls add(row, column) for every entry of either triangle, in any order and with
// repetitions; the diagonal is always present. block: unknowns ordered together
// (SparsePattern::order_in_blocks).
template <class Each>
SparsePattern pattern_of_pairs(Index size, Index block, const Each& each) {
  std::vector<std::vector<Index>> below(to_size(size));
  each([&](Index row, Index column) {
    if (row != column) below[std::min(row, column)].push_back(std::max(row, column));
  });
  SparsePattern pattern;
  for (const auto& rows : below) pattern.append_column(rows);
  pattern.order_in_blocks(block);
  return pattern;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
