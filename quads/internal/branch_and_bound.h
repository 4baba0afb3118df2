// Whole numbers n of least cost from a flow in halves.
//
// The least cost of a flow in the network is a lower bound of that of whole numbers. Where n_a =
// k + 1/2 there are two branches, n_a <= k and n_a >= k + 1: both are searched, the cheaper one
// first, and those whose bound is not below the best known cost are left out.
//
//   const MinCostFlow flow(network, {});
//   const std::vector<Index> edges = branch_and_bound(flow, search, Effort::Least, stop);
#pragma once

#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/quads/internal/min_cost_flow.h"

namespace majorant {

// What is searched: the first numbers that are found, close to the least sum; or all others too
// that may have a lower one, in at most kMostDescents steps of the search, so that it is the least
// sum where these were enough.
enum class Effort { First, Least };
// Chosen: on the public meshes searches that end at all do so after some 120.
inline constexpr long kMostDescents = 200;

// flow: balanced. Returns the numbers by arc, or nothing where there are no whole numbers. Throws
// Stopped.
std::vector<Index> branch_and_bound(const MinCostFlow& flow, TwoSidedSearch& search, Effort effort,
                                    const StopCheck& stop);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
