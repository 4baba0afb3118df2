// Disjoint sets of the numbers 0 .. count - 1 that can only be merged, for connected components.
//
//   UnionFind components(mesh->face_count());
//   for (Index h = 0; h < mesh->half_edge_count(); ++h)
//     if (mesh->opposite(h) >= 0) components.join(face_of(h), face_of(mesh->opposite(h)));
//   const bool connected = components.find(12) == components.find(13);
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "majorant/framework/types.h"

namespace majorant {

class UnionFind {
 public:
  explicit UnionFind(Index count) : parent_(to_size(count)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  // Returns the smallest member of i's set, which represents it.
  Index find(Index i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];  // path halving
    return i;
  }

  // Merges the sets of i and k. Returns whether they were different.
  bool join(Index i, Index k) {
    const auto [small, large] = std::minmax({find(i), find(k)});
    parent_[large] = small;
    return small != large;
  }

 private:
  std::vector<Index> parent_;  // never larger than the number itself
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
