// Changes of polygon lists for tests that IndexLists does not have.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "majorant/framework/types.h"
#include "majorant/mesh/index_lists.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

inline std::vector<std::vector<Index>> vectors_of(const IndexLists& lists) {
  std::vector<std::vector<Index>> vectors;
  for (const auto list : lists) vectors.emplace_back(list.begin(), list.end());
  return vectors;
}

// Applies change(lists as vectors).
template <class Change>
void change_lists(IndexLists& lists, const Change& change) {
  std::vector<std::vector<Index>> vectors = vectors_of(lists);
  change(vectors);
  lists = vectors;
}

inline void set_list(IndexLists& lists, std::size_t k, const std::vector<Index>& list) {
  change_lists(lists, [&](auto& vectors) { vectors[k] = list; });
}

inline void swap_lists(IndexLists& lists, std::size_t a, std::size_t b) {
  change_lists(lists, [&](auto& vectors) { std::swap(vectors[a], vectors[b]); });
}

inline void erase_lists(IndexLists& lists, std::size_t first, std::size_t count) {
  change_lists(lists, [&](auto& vectors) {
    const auto begin = vectors.begin() + static_cast<std::ptrdiff_t>(first);
    vectors.erase(begin, begin + static_cast<std::ptrdiff_t>(count));
  });
}

// Reverses each list.
inline void reverse_lists(IndexLists& lists) {
  for (const auto list : lists) std::reverse(list.begin(), list.end());
}

// Appends lists whose vertices are numbered from `first`.
inline void append_lists(IndexLists& lists, const IndexLists& more, Index first) {
  const std::size_t before = lists.indices().size();
  lists.append(more);
  for (Index& index : lists.indices().subspan(before)) index += first;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
