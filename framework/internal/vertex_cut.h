// The smallest set of nodes that separates the sources of a graph from its sinks: a maximum flow
// through nodes of capacity one (Dinic's method).
//
//   SparsePattern pattern;                  // 0 - 1 - 2
//   pattern.append_column({1});
//   pattern.append_column({2});
//   pattern.append_column({});
//   pattern.order_in_blocks(1);
//   using enum VertexCut::Terminal;
//   VertexCut cut(BlockNeighbours{BlockGraph(pattern)}, {Source, None, Sink});
//   const bool is_first = cut.near_sources()[0] == VertexCut::Side::Separator;   // true
#pragma once

#include <vector>

#include "majorant/framework/internal/block_neighbours.h"

namespace majorant {

class VertexCut {
 public:
  enum class Terminal : char { None, Source, Sink };
  enum class Side : char { Sources, Separator, Sinks };

  // terminals: for each node. Sources and sinks may be in the separator, too. Time is at most
  // proportional to the edges times the root of the nodes; on bands of meshes, to ten times the
  // edges.
  VertexCut(BlockNeighbours near, std::vector<Terminal> terminals);

  // The sides of all nodes: near_sources() with the fewest nodes on the side of the sources,
  // near_sinks() with the fewest on that of the sinks. Both separators have the same size. Nodes
  // that no terminal reaches are on the other side.
  const std::vector<Side>& near_sources() const { return near_sources_; }
  const std::vector<Side>& near_sinks() const { return near_sinks_; }

 private:
  // A path enters a node (state 2 k) and leaves it (2 k + 1).
  static constexpr Index kNone = -1, kEnd = -2;

  // Returns true if a path can end in the node.
  bool is_last(Index node) const {
    return terminals_[node] == Terminal::Sink && next_[node] != kEnd;
  }
  Index after_entering(Index node) const;
  Index after_leaving(Index node);
  bool find_levels();
  bool find_path(Index first);
  void add_path();
  void reverse();
  std::vector<Side> sides(Side here, Side there) const;

  BlockNeighbours near_;
  std::vector<Terminal> terminals_;
  // The nodes before and after each node on its path; kEnd: the path begins or ends here.
  std::vector<Index> previous_, next_;
  // For each state, its distance from the sources; for each node, the number of tried neighbours;
  // the states of a search and of a path.
  std::vector<Index> level_, tried_, queue_, path_;
  std::vector<Side> near_sources_, near_sinks_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
