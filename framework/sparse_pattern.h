// The fixed sparsity pattern of a symmetric matrix: lower triangle, compressed columns, row numbers
// sorted within a column, every diagonal entry present.
//
//   SparsePattern pattern;                  // of  [ 2 -1  . ]
//   pattern.append_column({1});             //     [-1  2 -1 ]
//   pattern.append_column({2});             //     [ . -1  2 ]
//   pattern.append_column({});
//   pattern.order_in_blocks(1);
//   Vec values = Vec::Zero(pattern.nonzeros());
//   values[pattern.slot(0, 1)] = -1;        // the same as slot(1, 0)
#pragma once

#include <vector>

#include "majorant/framework/types.h"

namespace majorant {

struct SparsePattern {
  Index size = 0;
  std::vector<Index> column_starts = {0};  // size + 1
  std::vector<Index> rows;                 // nonzeros
  std::vector<Index> block_of;             // size: unknowns with equal numbers are ordered together
  Index nonzeros() const { return static_cast<Index>(rows.size()); }

  // Makes the next column, which gets its diagonal entry and these: rows below the diagonal, in any
  // order, some maybe several times. Throws Error(Unsupported) where entries become more than an
  // Index counts.
  void append_column(const std::vector<Index>& rows_below);
  // Unknowns 0 .. block - 1 belong together, the next so many, and so on.
  void order_in_blocks(Index block);

  // The entries of this pattern and of `more`, which has as many columns or more, and the latter's
  // blocks. places: where this pattern's entries are in the result.
  SparsePattern joined(const SparsePattern& more, std::vector<Index>& places) const;

  // Where the value of an entry is: parallel to `rows`; either triangle. Throws InvalidArgument for
  // an entry that is not there.
  Index slot(Index row, Index column) const;
  Index diagonal_slot(Index column) const { return column_starts[column]; }
};

// Throws InvalidArgument unless a pattern is what the head of this file says, with a block for
// every unknown, equal numbers next to each other, counted from 0.
void require_valid(const SparsePattern& pattern);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
