// Edges of the input whose two sides may have other uv, told by their vertices.
//
//   AllowedEdges allowed({{{3, 7}, {7, 8}}});
//   if (!allowed.take({7, 3})) ...             // (3, 7) is not listed, or not once more
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <vector>

#include "majorant/framework/types.h"

namespace majorant {

class AllowedEdges {
 public:
  // Each as often as it is listed, in any order of its vertices; none given: all.
  explicit AllowedEdges(const std::optional<std::vector<std::array<Index, 2>>>& edges)
      : is_any_(!edges) {
    if (edges)
      for (const auto& edge : *edges) ++left_[sorted(edge)];
  }

  bool take(const std::array<Index, 2>& edge) {
    if (is_any_) return true;
    const auto entry = left_.find(sorted(edge));
    return entry != left_.end() && entry->second-- > 0;
  }

 private:
  static std::array<Index, 2> sorted(const std::array<Index, 2>& edge) {
    return {std::min(edge[0], edge[1]), std::max(edge[0], edge[1])};
  }

  bool is_any_;
  std::map<std::array<Index, 2>, Index> left_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
