// A density of invariants of volumes as its kernels call it (point_functions.h says why through
// pointers). No inline functions: kernels see this file.
#pragma once

#include "majorant/energies/detail/contraction.h"
#include "majorant/energies/detail/point_functions.h"

namespace majorant {

// f(n, q, d): rows n, q, d of invariants, one number a point.
struct SolidInvariantFunction {
  const void* formula;
  void (*values)(const void* formula, const PointBatch&, const double* invariants, double* f);
  // Rows: the value, the first derivatives, the lower triangle of the second ones.
  void (*jets)(const void* formula, const PointBatch&, const double* invariants, double* jets);
};

// Its kernels for the widest instructions of this machine.
DensityKernels solid_invariant_kernels();

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
