// A coarse graph: each of its nodes stands for a node of another graph and the nodes around it.
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
  // Returns the graph of some nodes, numbered by their position in the list, and the edges between
  // them.
  WeightedGraph among(std::span<const Index> some) const;
};

struct CoarseGraph {
  WeightedGraph graph;         // weights: the number of nodes and edges of the other graph
  std::vector<Index> node_of;  // the coarse node of each node

  // Coarsens to at most `few` nodes if possible, in time proportional to the edges.
  CoarseGraph(const BlockNeighbours& near, Index few);
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
