// Views of this library's matrices in the types of CHOLMOD.
#pragma once

#include <cholmod.h>

#include <algorithm>
#include <type_traits>
#include <vector>

#include "majorant/framework/linear_solver.h"

namespace majorant {

static_assert(std::is_same_v<int, Index>, "CHOLMOD's other functions have 64 bits");

// Returns a view of a lower triangle with these column starts and rows, which must outlive it.
// values may be null.
inline cholmod_sparse lower_triangle(Index size, const std::vector<Index>& starts,
                                     const std::vector<Index>& rows, const double* values) {
  cholmod_sparse m{};
  m.nrow = m.ncol = to_size(size);
  m.nzmax = rows.size();
  m.p = const_cast<Index*>(starts.data());
  m.i = const_cast<Index*>(rows.data());
  m.x = const_cast<double*>(values);
  m.stype = -1;
  m.itype = CHOLMOD_INT;
  m.xtype = values ? CHOLMOD_REAL : CHOLMOD_PATTERN;
  m.dtype = CHOLMOD_DOUBLE;
  m.sorted = m.packed = 1;
  return m;
}

// Returns the unknowns of the blocks, block after block in this order.
inline std::vector<Index> order_of_unknowns(const std::vector<Index>& blocks,
                                            const SparsePattern& p) {
  std::vector<Index> position(blocks.size()), order(to_size(p.size));
  for (std::size_t k = 0; k < blocks.size(); ++k) position[blocks[k]] = static_cast<Index>(k);
  for (Index i = 0; i < p.size; ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
    return position[p.block_of[a]] < position[p.block_of[b]];
  });
  return order;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
