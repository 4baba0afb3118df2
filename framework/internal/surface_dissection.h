// Nested dissection for graphs of surfaces. Parts of a coarse graph (coarse_graph.h), halved again
// and again, give the approximate places of separators. The smallest separators near these borders
// (vertex_cut.h) are eliminated last; the parts between them are ordered by minimum degree. Factors
// have some 7 % more entries than with METIS's orders, which take five times as long.
//
//   SparsePattern pattern;
//   pattern.append_column({});
//   pattern.order_in_blocks(1);
//   const std::vector<Index> order = surface_dissection(BlockNeighbours{BlockGraph(pattern)});
#pragma once

#include <vector>

#include "majorant/framework/internal/block_neighbours.h"

namespace majorant {

// Returns the nodes in the order of their elimination, which is the same for any number of threads.
// The order is valid for every graph; it pays if nodes have few neighbours and separators are
// lines. Throws std::bad_alloc. Calls run one at a time, as those of nested_dissection_order() do.
std::vector<Index> surface_dissection(const BlockNeighbours& near);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
