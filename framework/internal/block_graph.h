// The graph of the blocks of a sparse pattern: two blocks are joined if an entry couples them.
// Orderings and symbolic eliminations work on this graph.
//
//   SparsePattern pattern;
//   pattern.append_column({});
//   pattern.order_in_blocks(1);
//   const BlockGraph graph(pattern);    // one node, no edge
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "majorant/framework/linear_solver.h"

namespace majorant {

// Pairs of blocks.
using BlockEdges = std::vector<std::pair<Index, Index>>;

// Stores every edge once, at its smaller node.
class BlockGraph {
 public:
  explicit BlockGraph(const SparsePattern& pattern);

  Index size() const { return static_cast<Index>(starts_.size()) - 1; }
  std::size_t edges() const { return larger_.size(); }
  // Returns the neighbours of `node` with larger numbers, each once, in the order of the pattern.
  std::span<const Index> larger(Index node) const {
    return {larger_.data() + starts_[node], larger_.data() + starts_[node + 1]};
  }
  // Returns the edges that `other`, a graph with as many nodes, does not have.
  BlockEdges edges_beyond(const BlockGraph& other) const;

 private:
  std::vector<Index> starts_, larger_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
