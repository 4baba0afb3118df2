// The consequences of an order of elimination: the blocks that every block touches in the end, and
// those that are eliminated together (supernodes, relaxed [AG89]).
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

// order: every node once; it is changed to a postorder of its elimination tree, which fills in no
// more. Time as the factor's structure, blocks counted.
BlockElimination analyze_elimination(const BlockGraph& graph, std::vector<Index> order);

// The nodes of a forest, children before parents, children of one and roots in the order in which
// `siblings`, every node once, has them. parent: -1 for roots.
std::vector<Index> postorder(const std::vector<Index>& parent, const std::vector<Index>& siblings);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
