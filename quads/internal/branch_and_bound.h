// Finds integers n of least cost, starting from a flow in halves.
//
// The least cost of a flow in the network is a lower bound for integers. At n_a = k + 1/2 there are
// two branches, n_a <= k and n_a >= k + 1. Both are searched, the cheaper one first, and branches
// whose bound is not below the best known cost are skipped.
//
//   const MinCostFlow flow(network, {});
//   const std::vector<Index> edges = branch_and_bound(flow, search, SearchEffort::Least, stop);
#pragma once

#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/quads/internal/min_cost_flow.h"

namespace majorant {

// First: stop at the first integers, which are close to the least sum. Least: search on for lower
// sums, with at most kMaxDescents steps; the sum is least if these suffice.
enum class SearchEffort { First, Least };
// Searches of the benchmark that end at all do so after about 120. Chosen, not tuned.
inline constexpr long kMaxDescents = 200;

// Returns the integers by arc; empty if there are none. flow: balanced. Throws Stopped.
std::vector<Index> branch_and_bound(const MinCostFlow& flow, TwoSidedSearch& search,
                                    SearchEffort effort, const StopCheck& stop);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
