// The neighbours of every node of a graph, as AMD and METIS take them.
//
//   SparsePattern pattern;
//   pattern.append_column({1});
//   pattern.append_column({});
//   pattern.order_in_blocks(1);
//   const BlockNeighbours near{BlockGraph(pattern)};
//   const Index other = near.of(0).front();  // 1
#pragma once

#include <span>
#include <vector>

#include "majorant/framework/internal/block_graph.h"

namespace majorant {

struct BlockNeighbours {
  std::vector<Index> starts = {0}, nodes;  // size() + 1; those of node k from starts[k] on

  BlockNeighbours() = default;
  // Throws Error(Unsupported) where neighbours become more than an Index counts.
  explicit BlockNeighbours(const BlockGraph& graph);

  Index size() const { return static_cast<Index>(starts.size()) - 1; }
  std::span<const Index> of(Index node) const {
    return {nodes.data() + starts[node], nodes.data() + starts[node + 1]};
  }
  // The graph of some nodes, numbered as in the list, and the edges between them.
  BlockNeighbours among(const std::vector<Index>& some) const;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
