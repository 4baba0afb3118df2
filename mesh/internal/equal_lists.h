// Lists of the same numbers, in whatever order each has them: faces with the same vertices.
#pragma once

#include <vector>

#include "majorant/mesh/index_lists.h"

namespace majorant {

// For every list a number, equal for lists of the same numbers.
std::vector<Index> classes_of_lists(IndexLists lists);

// For every list how many before it have the same numbers.
std::vector<Index> ranks_of_lists(IndexLists lists);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
