// The dense arithmetic of a sparse Cholesky factorization: one front at a time, by the widest
// vector instructions of the machine.
//
// A front has `columns` unknowns that it eliminates and `rows` >= columns unknowns altogether. Its
// part of the factor is a panel: rows by columns, column by column, `stride` apart (a multiple of
// kTile, >= rows, the rest 0), the upper triangle unused. What it leaves to the unknowns below is
// an update: a square of rows - columns, lower triangle, its stride a multiple of kTile as well.
//
// Every number comes from the same operations in the same order, whatever the width of the
// instructions; all but the baseline's fuse multiplications and additions. So factors are the same
// to the last bit on machines with AVX2 and with AVX-512.
#pragma once

#include <cstddef>
#include <vector>

#include "majorant/framework/types.h"

namespace majorant {

struct FrontKernels {
  // Rows that are worked on together: the doubles of the widest vector.
  static constexpr Index kTile = 8;
  // The distance from one column to the next: 64 bits, since a panel may have more than 2^31
  // numbers.
  using Stride = std::ptrdiff_t;

  const char* name;  // of the instruction set: "AVX-512"
  // Cholesky factor of the first `columns` columns in place, of columns first to last - 1 alone,
  // whose updates by earlier ones are done. False: a pivot is not positive.
  bool (*factorize)(double* panel, Stride stride, Index first, Index last);
  // Rows first_row to rows - 1 of columns first to last - 1, in tiles of kTile rows, the last one
  // filled up with 0: tile t at t * kTile * (last - first).
  void (*pack)(const double* panel, Stride stride, Index rows, Index first_row, Index first,
               Index last, double* packed);
  // target -= P P^T, lower triangle (and what of the upper one shares tiles with it), of columns
  // kTile * first_tile to min(kTile * last_tile, columns) - 1; P: `tiles` tiles of that depth.
  void (*update)(double* target, Stride stride, Index columns, const double* packed, Index tiles,
                 Index depth, Index first_tile, Index last_tile);
  // Solves with the panel's triangle, in place: x[0 .. columns), and takes the result out of the
  // rows below: x[columns .. rows). x has `stride` entries.
  void (*forward)(const double* panel, Stride stride, Index columns, double* x);
  // Solves with its transpose; x[columns .. rows) is known.
  void (*backward)(const double* panel, Stride stride, Index columns, double* x);
};

std::vector<const FrontKernels*> all_front_kernels();  // of this machine, the widest last
const FrontKernels& front_kernels();                   // the widest

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
