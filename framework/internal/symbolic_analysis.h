// The consequences of an order of elimination: the blocks that every block finally touches, and the
// blocks that are eliminated together (supernodes, relaxed [AG89]).
//
//   SparsePattern pattern;
//   pattern.append_column({});
//   pattern.order_in_blocks(1);
//   const BlockElimination elimination = analyze_elimination(BlockGraph(pattern), {0});
#pragma once

#include <vector>

#include "majorant/framework/internal/assembly_tree.h"
#include "majorant/framework/internal/block_graph.h"

namespace majorant {

// order: every node once. It is changed to a postorder of its elimination tree, which has the same
// fill-in. Time is proportional to the factor's structure, counted in blocks.
BlockElimination analyze_elimination(const BlockGraph& graph, std::vector<Index> order);

// Returns the nodes of a forest, children before parents. Children of one parent, and roots, keep
// their order in `siblings`, which has every node once. parent: -1 for roots.
std::vector<Index> postorder(const std::vector<Index>& parent, const std::vector<Index>& siblings);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
