// A graph of far fewer nodes, each of which stands for a node of another graph and its
// surroundings.
//
//   SparsePattern pattern;                  // 0 - 1 - 2
//   pattern.append_column({1});
//   pattern.append_column({2});
//   pattern.append_column({});
//   pattern.order_in_blocks(1);
//   const CoarseGraph coarse(BlockNeighbours{BlockGraph(pattern)}, 1);
//   const Index weight = coarse.graph.weights[coarse.node_of[0]];   // 3
#pragma once

#include <span>
#include <vector>

#include "majorant/framework/internal/block_neighbours.h"

namespace majorant {

struct WeightedGraph {
  BlockNeighbours near;
  std::vector<Index> weights;       // of nodes
  std::vector<Index> edge_weights;  // parallel to near.nodes

  Index size() const { return near.size(); }
  // The graph of some nodes, numbered as in the list, and the edges between them.
  WeightedGraph among(std::span<const Index> some) const;
};

struct CoarseGraph {
  WeightedGraph graph;         // weights: nodes and edges of the other graph
  std::vector<Index> node_of;  // of each of its nodes

  // At most `few` nodes, where the graph can be made so coarse. Time as the edges.
  CoarseGraph(const BlockNeighbours& near, Index few);
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
