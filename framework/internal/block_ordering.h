// Orders of elimination in which little is filled in: those of AMD [ADD04] and METIS [KK98], and of
// surfaces by nested dissection (surface_dissection.h). The libraries are called by these two and
// nowhere else.
//
//   SparsePattern pattern;
//   pattern.append_column({});
//   pattern.order_in_blocks(1);
//   const std::vector<Index> order =
//       fill_reducing_order(BlockGraph(pattern), Ordering::Automatic).order;
#pragma once

#include <string_view>
#include <vector>

#include "majorant/framework/internal/block_graph.h"
#include "majorant/framework/linear_solver.h"

namespace majorant {

// The nodes, in the order of their elimination, by METIS. Waits for its turn: METIS shares state of
// the process (MetisScope). Throws std::bad_alloc.
std::vector<Index> nested_dissection_order(const BlockGraph& graph);

// The nodes, in the order of their elimination, by AMD; of elements of higher degree AMD orders the
// corners (covered_nodes.h). Throws std::bad_alloc.
struct MinimumDegreeOrder {
  std::vector<Index> order;
  double operations = 0;  // multiplications of a factorization of one unknown a node, about
};
MinimumDegreeOrder minimum_degree_order(const BlockGraph& graph);

struct FillReducingOrder {
  Ordering method = Ordering::Amd;  // not Automatic
  std::vector<Index> order;
};
// Automatic: surfaces by nested dissection, where they are large enough for that; else by AMD, and
// by METIS where that pays within some factorizations.
FillReducingOrder fill_reducing_order(const BlockGraph& graph, Ordering method);

// "AMD", "METIS", "nested dissection".
std::string_view name_of(Ordering ordering);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
