// The dense arithmetic of a sparse Cholesky factorization: one front at a time, by the widest
// vector instructions of the machine.
//
// A front has `rows` unknowns, of which it eliminates the first `columns`. Its part of the factor
// is a panel: rows by columns, column by column, `stride` apart (a multiple of kTile, >= rows, the
// rest 0), the upper triangle unused. Its contribution to the unknowns below is an update: a square
// matrix of size rows - columns, lower triangle, whose stride is a multiple of kTile as well.
//
// Every number comes from the same operations in the same order, whatever the width of the
// instructions. All instruction sets but the baseline fuse multiplications and additions, so
// factors are the same, bit for bit, on machines with AVX2 and with AVX-512.
#pragma once

#include <cstddef>
#include <vector>

#include "majorant/framework/types.h"

namespace majorant {

struct FrontKernels {
  // The rows that are processed together: the doubles of the widest vector.
  static constexpr Index kTile = 8;
  // The distance from one column to the next: 64 bits, since a panel may have more than 2^31
  // numbers.
  using Stride = std::ptrdiff_t;

  const char* name;  // of the instruction set: "AVX-512"
  // Factorizes columns first to last - 1 in place; updates by earlier columns are already applied.
  // Returns false if a pivot is not positive.
  bool (*factorize)(double* panel, Stride stride, Index first, Index last);
  // Packs rows first_row to rows - 1 of columns first to last - 1 into tiles of kTile rows; the
  // last tile is filled up with 0. Tile t begins at t * kTile * (last - first).
  void (*pack)(const double* panel, Stride stride, Index rows, Index first_row, Index first,
               Index last, double* packed);
  // Computes target -= P P^T in the lower triangle (and where tiles reach into the upper one), for
  // columns kTile * first_tile to min(kTile * last_tile, columns) - 1. P: `tiles` tiles of `depth`.
  void (*update)(double* target, Stride stride, Index columns, const double* packed, Index tiles,
                 Index depth, Index first_tile, Index last_tile);
  // Solves with the panel's triangle in place, x[0 .. columns), and subtracts the contribution of
  // the result from the rows below, x[columns .. rows). x has `stride` entries.
  void (*forward)(const double* panel, Stride stride, Index columns, double* x);
  // Solves with the transposed panel; x[columns .. rows) is known.
  void (*backward)(const double* panel, Stride stride, Index columns, double* x);
};

std::vector<const FrontKernels*> all_front_kernels();  // of this machine, the widest last
const FrontKernels& front_kernels();                   // the widest

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
