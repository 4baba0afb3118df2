// Fill-reducing orders of elimination: those of AMD [ADD04] and METIS [KK98], and for surfaces
// nested dissection (surface_dissection.h). Only this file and surface_dissection call the two
// libraries.
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

// Returns the nodes in the order of their elimination, by METIS. Calls run one at a time, since
// METIS shares state of the process (MetisScope). Throws std::bad_alloc.
std::vector<Index> nested_dissection_order(const BlockGraph& graph);

// The nodes in the order of their elimination, by AMD. For elements of higher degree AMD orders the
// corners alone (covered_nodes.h). Throws std::bad_alloc.
struct MinimumDegreeOrder {
  std::vector<Index> order;
  double operations = 0;  // multiplications of a factorization with one unknown a node, estimated
};
MinimumDegreeOrder minimum_degree_order(const BlockGraph& graph);

struct FillReducingOrder {
  Ordering method = Ordering::Amd;  // not Automatic
  std::vector<Index> order;
};
// Automatic chooses nested dissection for surfaces that are large enough, otherwise METIS if it
// pays within a few factorizations, otherwise AMD.
FillReducingOrder fill_reducing_order(const BlockGraph& graph, Ordering method);

// Returns "AMD", "METIS" or "nested dissection".
std::string_view name_of(Ordering ordering);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
