// The storage of a lower trapezoid, rows by columns, in a front. It has slabs of kColumns columns,
// each with the rows from its first diagonal entry on, so that the upper triangle takes hardly any
// memory. A slab is a dense matrix stored by columns, a trapezoid of its own, which FrontKernels
// work on.
//
//   const ColumnSlabs shape{208, 100};                // 208 rows, 100 columns
//   std::vector<double> values(shape.size());         // 208 * 64 + 144 * 36
//   values[shape.column(70) + 80] = 1;                // row 80 of column 70
//   for (Index s = 0; s < shape.slabs(); ++s)
//     front_kernels().factorize(values.data() + shape.begin(s), shape.stride(s), 0,
//                               shape.columns_of(s));
#pragma once

#include <algorithm>
#include <cstddef>

#include "majorant/framework/internal/front_kernels.h"

namespace majorant {

struct ColumnSlabs {
  // The columns that are eliminated before the rest is updated: 1000 rows of them fit into a
  // second-level cache.
  static constexpr Index kColumns = 64;
  static_assert(kColumns % FrontKernels::kTile == 0);

  FrontKernels::Stride rows = 0;  // a multiple of kTile
  Index columns = 0;              // <= rows

  Index slabs() const { return (columns + kColumns - 1) / kColumns; }
  Index columns_of(Index slab) const { return std::min(kColumns, columns - slab * kColumns); }
  // The number of rows of a slab, which is the distance between its columns.
  FrontKernels::Stride stride(Index slab) const { return rows - slab * kColumns; }
  // Returns the position of a slab's first diagonal entry.
  std::ptrdiff_t begin(Index slab) const {
    const std::ptrdiff_t before = slab;
    return before * kColumns * rows - before * (before - 1) / 2 * kColumns * kColumns;
  }
  // Returns the position of row 0 of a column, as if the rows above its slab were stored.
  std::ptrdiff_t column(Index c) const {
    const Index slab = c / kColumns, skipped = slab * kColumns;
    return begin(slab) + (c - skipped) * stride(slab) - skipped;
  }
  std::size_t size() const {
    const Index last = std::max(slabs(), 1) - 1;
    return static_cast<std::size_t>(begin(last) + stride(last) * columns_of(last));
  }
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
