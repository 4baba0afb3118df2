// Compares lists as sets of numbers, in any order: faces with the same vertices.
#pragma once

#include <vector>

#include "majorant/mesh/index_lists.h"

namespace majorant {

// Returns a number for every list, equal for lists of the same numbers.
std::vector<Index> classes_of_lists(IndexLists lists);

// Returns for every list how many lists before it have the same numbers.
std::vector<Index> ranks_of_lists(IndexLists lists);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
