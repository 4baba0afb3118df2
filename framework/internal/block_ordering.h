// Orders of elimination in which little is filled in: those of AMD [ADD04] and METIS [KK98], whose
// libraries are called here and nowhere else.
//
//   SparsePattern pattern;
//   pattern.append_column({});
//   pattern.order_in_blocks(1);
//   const std::vector<Index> order = minimum_degree_order(BlockGraph(pattern));
#pragma once

#include <vector>

#include "majorant/framework/internal/block_graph.h"
#include "majorant/framework/linear_solver.h"

namespace majorant {

// The nodes, in the order of their elimination. Both throw std::bad_alloc.
std::vector<Index> minimum_degree_order(const BlockGraph& graph);
// Waits for its turn: METIS shares state of the process (MetisScope).
std::vector<Index> nested_dissection_order(const BlockGraph& graph);

// Automatic: Amd, for large graphs Metis. Others stay.
Ordering chosen_ordering(Ordering asked, const BlockGraph& graph);
// An order of little fill-in by AMD or METIS, as chosen.
std::vector<Index> fill_reducing_order(const BlockGraph& graph, Ordering chosen);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
