// Sends lists of different lengths from rank 0 to all ranks, and from all ranks to rank 0.
//
//     const std::vector<double> mine = scattered(ranks, of_ranks);       // of_ranks: rank 0's
//     const std::vector<std::vector<double>> all = gathered(ranks, mine);    // empty elsewhere
//
// Integers are sent as doubles, which represent all of them up to 2^53.
#pragma once

#include <string>
#include <vector>

#include "majorant/framework/partition.h"

namespace majorant {

std::vector<double> scattered(const Ranks& ranks, std::vector<std::vector<double>> of_ranks);
std::vector<std::vector<double>> gathered(const Ranks& ranks, std::vector<double> mine);
// Returns the list of rank 0.
std::vector<double> broadcast(const Ranks& ranks, std::vector<double> of_first);
std::string broadcast(const Ranks& ranks, std::string of_first);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
