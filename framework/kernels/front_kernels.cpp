// This file is compiled once for each instruction set (cmake/kernels.cmake names the function). It
// must not instantiate inline code that other files share.
#include "majorant/framework/internal/front_kernels.h"

#include <xsimd/xsimd.hpp>

namespace majorant {
namespace {

using Batch = xsimd::batch<double>;
using Stride = FrontKernels::Stride;
constexpr Index kTile = FrontKernels::kTile;
constexpr Index kLanes = static_cast<Index>(Batch::size);
constexpr Index kParts = kTile / kLanes;  // batches in a tile of rows
// The columns that are processed together: their sums stay in registers. The results are the same
// for any number.
constexpr Index kColumns = kLanes >= 8 ? 8 : kLanes >= 4 ? 4 : 2;

// A column of kTile rows.
struct Rows {
  Batch part[kParts];
};

inline Rows load(const double* p) {
  Rows r;
  for (Index i = 0; i < kParts; ++i) r.part[i] = Batch::load_unaligned(p + i * kLanes);
  return r;
}

inline void store(double* p, const Rows& r) {
  for (Index i = 0; i < kParts; ++i) r.part[i].store_unaligned(p + i * kLanes);
}

// sum += a * b
inline void add_product(Rows& sum, const Rows& a, double b) {
  const Batch factor(b);
  for (Index i = 0; i < kParts; ++i) sum.part[i] = xsimd::fma(a.part[i], factor, sum.part[i]);
}

inline void subtract_product(Rows& from, const Rows& a, double b) {
  const Batch factor(b);
  for (Index i = 0; i < kParts; ++i) from.part[i] = xsimd::fnma(a.part[i], factor, from.part[i]);
}

inline void scale(Rows& r, double by) {
  const Batch factor(by);
  for (Index i = 0; i < kParts; ++i) r.part[i] *= factor;
}

inline void subtract(double* from, const Rows& r) {
  for (Index i = 0; i < kParts; ++i)
    (Batch::load_unaligned(from + i * kLanes) - r.part[i]).store_unaligned(from + i * kLanes);
}

// Multiplies one row of tiles with kColumns columns; `count` products at once.
template <int count>
inline void multiply(const double* a, Index a_tile, Stride a_stride, const double* b,
                     Stride b_stride, Index depth, Rows (&sum)[count][kColumns]) {
  for (int t = 0; t < count; ++t)
    for (Index c = 0; c < kColumns; ++c)
      for (Index i = 0; i < kParts; ++i) sum[t][c].part[i] = Batch(0.0);
  for (Index p = 0; p < depth; ++p) {
    Rows rows[count];
    for (int t = 0; t < count; ++t) rows[t] = load(a + t * a_tile + p * a_stride);
    for (Index c = 0; c < kColumns; ++c) {
      const Batch factor(b[p * b_stride + c]);
      for (int t = 0; t < count; ++t)
        for (Index i = 0; i < kParts; ++i)
          sum[t][c].part[i] = xsimd::fma(rows[t].part[i], factor, sum[t][c].part[i]);
    }
  }
}

// Subtracts the contributions of columns first to column - 1 from `width` columns of one tile of
// rows.
inline void subtract_earlier(double* panel, Stride stride, Index row, Index first, Index column,
                             Index width) {
  for (Index c = 0; c < width; c += kColumns) {
    Rows sum[1][kColumns];
    multiply<1>(panel + first * stride + row, 0, stride, panel + first * stride + column + c,
                stride, column - first, sum);
    for (Index k = 0; k < kColumns && c + k < width; ++k)
      subtract(panel + (column + c + k) * stride + row, sum[0][k]);
  }
}

// Factorizes the triangle at `column`, with the rest of its tile of rows. inverse: of the pivots.
inline bool factorize_triangle(double* panel, Stride stride, Index column, Index width,
                               double* inverse) {
  double* corner = panel + column * stride + column;
  for (Index c = 0; c < width; ++c) {
    double* pivots = corner + c * stride;
    if (!(pivots[c] > 0 && pivots[c] <= __DBL_MAX__)) return false;
    const double root = __builtin_sqrt(pivots[c]);
    inverse[c] = 1 / root;
    Rows rows = load(pivots);
    scale(rows, inverse[c]);
    store(pivots, rows);
    pivots[c] = root;
    for (Index k = c + 1; k < width; ++k) {
      Rows later = load(corner + k * stride);
      subtract_product(later, rows, pivots[k]);
      store(corner + k * stride, later);
    }
  }
  return true;
}

// width: 1 .. kTile, a constant in the inner loops.
template <class Width>
inline void eliminate(double* panel, Stride stride, Index row, Index column, Width width,
                      const double* inverse) {
  Rows rows[kTile];
  const double* corner = panel + column * stride + column;
  for (Index c = 0; c < width; ++c) {
    double* place = panel + (column + c) * stride + row;
    rows[c] = load(place);
    for (Index p = 0; p < c; ++p) subtract_product(rows[c], rows[p], corner[p * stride + c]);
    scale(rows[c], inverse[c]);
    store(place, rows[c]);
  }
}

struct FullWidth {
  constexpr operator Index() const { return kTile; }
};

bool factorize(double* panel, Stride stride, Index first, Index last) {
  double inverse[kTile];
  for (Index column = first; column < last; column += kTile) {
    const Index width = last - column < kTile ? last - column : kTile;
    if (column > first) subtract_earlier(panel, stride, column, first, column, width);
    if (!factorize_triangle(panel, stride, column, width, inverse)) return false;
    for (Index row = column + kTile; row < stride; row += kTile) {
      if (column > first) subtract_earlier(panel, stride, row, first, column, width);
      if (width == kTile)
        eliminate(panel, stride, row, column, FullWidth(), inverse);
      else
        eliminate(panel, stride, row, column, width, inverse);
    }
  }
  return true;
}

void pack(const double* panel, Stride stride, Index rows, Index first_row, Index first, Index last,
          double* packed) {
  const Index depth = last - first;
  Index row = first_row;
  for (; row + kTile <= rows; row += kTile)
    for (Index p = 0; p < depth; ++p, packed += kTile)
      store(packed, load(panel + (first + p) * stride + row));
  if (row == rows) return;
  for (Index p = 0; p < depth; ++p, packed += kTile)
    for (Index i = 0; i < kTile; ++i)
      packed[i] = row + i < rows ? panel[(first + p) * stride + row + i] : 0.0;
}

template <int count>
inline void update_tiles(double* target, Stride stride, Index width, const double* a,
                         const double* b, Index depth) {
  for (Index c = 0; c < width; c += kColumns) {
    Rows sum[count][kColumns];
    multiply<count>(a, depth * kTile, kTile, b + c, kTile, depth, sum);
    for (Index k = 0; k < kColumns && c + k < width; ++k)
      for (int t = 0; t < count; ++t) subtract(target + (c + k) * stride + t * kTile, sum[t][k]);
  }
}

void update(double* target, Stride stride, Index columns, const double* packed, Index tiles,
            Index depth, Index first_tile, Index last_tile) {
  constexpr int together = kParts == 1 ? 2 : 1;
  const Index tile_size = depth * kTile;
  for (Index c = first_tile; c < last_tile; ++c) {
    const Index width = columns - c * kTile < kTile ? columns - c * kTile : kTile;
    double* column = target + c * kTile * stride;
    Index r = c;
    for (; r + together <= tiles; r += together)
      update_tiles<together>(column + r * kTile, stride, width, packed + r * tile_size,
                             packed + c * tile_size, depth);
    for (; r < tiles; ++r)
      update_tiles<1>(column + r * kTile, stride, width, packed + r * tile_size,
                      packed + c * tile_size, depth);
  }
}

void forward(const double* panel, Stride stride, Index columns, double* x) {
  for (Index c = 0; c < columns; ++c) {
    const double* column = panel + c * stride;
    const double value = x[c] / column[c];
    x[c] = value;
    Index row = c + 1;
    for (; row % kTile != 0 && row < stride; ++row) x[row] -= column[row] * value;
    for (; row < stride; row += kTile) {
      Rows rows = load(x + row);
      subtract_product(rows, load(column + row), value);
      store(x + row, rows);
    }
  }
}

void backward(const double* panel, Stride stride, Index columns, double* x) {
  for (Index c = columns; c-- > 0;) {
    const double* column = panel + c * stride;
    double sum = x[c];
    Index row = c + 1;
    for (; row % kTile != 0 && row < stride; ++row) sum -= column[row] * x[row];
    Rows sums;
    for (Index i = 0; i < kParts; ++i) sums.part[i] = Batch(0.0);
    for (; row < stride; row += kTile) {
      const Rows a = load(column + row), b = load(x + row);
      for (Index i = 0; i < kParts; ++i)
        sums.part[i] = xsimd::fma(a.part[i], b.part[i], sums.part[i]);
    }
    double lanes[kTile];
    store(lanes, sums);
    x[c] = (sum - (((lanes[0] + lanes[1]) + (lanes[2] + lanes[3])) +
                   ((lanes[4] + lanes[5]) + (lanes[6] + lanes[7])))) /
           column[c];
  }
}

}  // namespace

extern const FrontKernels MAJORANT_KERNEL_NAME;
const FrontKernels MAJORANT_KERNEL_NAME{
    MAJORANT_INSTRUCTION_SET, factorize, pack, update, forward, backward};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
