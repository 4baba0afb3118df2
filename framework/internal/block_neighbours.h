// The neighbours of every node of a graph, in the format of AMD and METIS.
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
  std::vector<Index> starts = {0}, nodes;  // size() + 1; neighbours of node k begin at starts[k]

  BlockNeighbours() = default;
  // Throws Error(Unsupported) if the number of neighbours exceeds the range of Index.
  explicit BlockNeighbours(const BlockGraph& graph);

  Index size() const { return static_cast<Index>(starts.size()) - 1; }
  std::span<const Index> of(Index node) const {
    return {nodes.data() + starts[node], nodes.data() + starts[node + 1]};
  }
  // Returns the graph of some nodes, numbered by their position in the list, and the edges between
  // them.
  BlockNeighbours among(const std::vector<Index>& some) const;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
