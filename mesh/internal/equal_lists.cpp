#include "majorant/mesh/internal/equal_lists.h"

#include <algorithm>
#include <numeric>

namespace majorant {
namespace {

// Sorts each list, and returns the order of the sorted lists; equal lists keep their order.
std::vector<Index> sorted_order(IndexLists& lists) {
  for (const auto list : lists) std::sort(list.begin(), list.end());
  std::vector<Index> order(lists.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
    return std::ranges::lexicographical_compare(lists[a], lists[b]);
  });
  return order;
}

}  // namespace

std::vector<Index> classes_of_lists(IndexLists lists) {
  const std::vector<Index> order = sorted_order(lists);
  std::vector<Index> number(lists.size(), 0);
  for (std::size_t k = 1; k < order.size(); ++k)
    number[order[k]] =
        number[order[k - 1]] + !std::ranges::equal(lists[order[k]], lists[order[k - 1]]);
  return number;
}

std::vector<Index> ranks_of_lists(IndexLists lists) {
  const std::vector<Index> order = sorted_order(lists);
  std::vector<Index> rank(lists.size(), 0);
  for (std::size_t k = 1; k < order.size(); ++k)
    if (std::ranges::equal(lists[order[k]], lists[order[k - 1]]))
      rank[order[k]] = rank[order[k - 1]] + 1;
  return rank;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
