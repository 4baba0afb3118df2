// Orders of elimination for graphs of elements of degree 2 and more, from their corners.
//
// A node covers a neighbour if all other neighbours of that neighbour are its own, too. The corners
// of elements cover the nodes of all adjacent edges, faces and interiors; no node covers a corner,
// except for some at a boundary. Two covered nodes are neighbours only if their coverers are
// neighbours or the same. So a separator of the uncovered nodes separates all nodes. A covered node
// is eliminated right before the first node that covers it, and then adds no fill across a
// separator. A map of degree 3 has nine times as many nodes as corners.
//
//   SparsePattern pattern;                  // 0 - 1 - 2: node 1 covers both ends
//   pattern.append_column({1});
//   pattern.append_column({2});
//   pattern.append_column({});
//   pattern.order_in_blocks(1);
//   const BlockNeighbours near{BlockGraph(pattern)};
//   const std::vector<Index> order = order_with_covered(near, uncovered_nodes(near));
#pragma once

#include <vector>

#include "majorant/framework/internal/block_neighbours.h"

namespace majorant {

// Returns the nodes that no node covers, ascending; of nodes that cover each other it returns the
// first. Time and memory are proportional to the edges times the neighbours of a node.
std::vector<Index> uncovered_nodes(const BlockNeighbours& near);

// Returns whether so many nodes are covered that ordering the others alone pays. Tests a sample,
// which takes no time.
bool has_many_covered_nodes(const BlockNeighbours& near);

// Returns all nodes: each of `uncovered`, which are those of uncovered_nodes() in any order, right
// after the nodes that it is the first to cover.
std::vector<Index> order_with_covered(const BlockNeighbours& near,
                                      const std::vector<Index>& uncovered);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
