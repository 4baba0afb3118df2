// Orders of elimination for graphs of surfaces, by nested dissection: parts of a coarse graph
// (coarse_graph.h), halved again and again, tell where separators are to be; the smallest ones near
// these borders (vertex_cut.h) are eliminated last, and what is left by minimum degrees in front of
// them. Factors have some 7 % more entries than by METIS's orders, which take five times as long.
//
//   SparsePattern pattern;
//   pattern.append_column({});
//   pattern.order_in_blocks(1);
//   const std::vector<Index> order = surface_dissection(BlockNeighbours{BlockGraph(pattern)});
#pragma once

#include <vector>

#include "majorant/framework/internal/block_neighbours.h"

namespace majorant {

// The nodes, in the order of their elimination: the same one for any number of threads. Right for
// every graph; worth its time where nodes have few neighbours and separators are lines. Throws
// std::bad_alloc. Waits for its turn as nested_dissection_order() does.
std::vector<Index> surface_dissection(const BlockNeighbours& near);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
