#include "majorant/framework/internal/block_graph.h"

#include <algorithm>

namespace majorant {

BlockGraph::BlockGraph(const SparsePattern& p) {
  Index blocks = 0;
  for (const Index b : p.block_of) blocks = std::max(blocks, b + 1);
  std::vector<std::size_t> place(to_size(blocks) + 1, 0);
  const auto visit = [&](const auto& use) {
    for (Index c = 0; c < p.size; ++c)
      for (Index k = p.column_starts[c]; k < p.column_starts[c + 1]; ++k) {
        const Index a = p.block_of[c], b = p.block_of[p.rows[k]];
        if (a != b) use(std::min(a, b), std::max(a, b));
      }
  };
  visit([&](Index smaller, Index) { ++place[smaller + 1]; });
  for (std::size_t b = 1; b < place.size(); ++b) place[b] += place[b - 1];
  std::vector<Index> all(place.back()), seen(to_size(blocks), -1);
  std::vector<std::size_t> next(place);
  visit([&](Index smaller, Index larger) { all[next[smaller]++] = larger; });
  starts_.push_back(0);
  for (Index b = 0; b < blocks; ++b) {
    for (std::size_t k = place[b]; k < place[b + 1]; ++k)
      if (seen[all[k]] != b) {
        seen[all[k]] = b;
        larger_.push_back(all[k]);
      }
    starts_.push_back(static_cast<Index>(larger_.size()));
  }
}

BlockEdges BlockGraph::edges_beyond(const BlockGraph& other) const {
  BlockEdges edges;
  std::vector<Index> seen(to_size(size()), -1);
  for (Index b = 0; b < size(); ++b) {
    for (const Index c : other.larger(b)) seen[c] = b;
    for (const Index c : larger(b))
      if (seen[c] != b) edges.push_back({b, c});
  }
  return edges;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
