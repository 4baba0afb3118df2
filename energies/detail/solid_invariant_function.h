// A density of invariants of volumes as its kernels call it; point_functions.h has the reason for
// the pointers. There are no inline functions, since kernels include this file.
#pragma once

#include "majorant/energies/detail/contraction.h"
#include "majorant/energies/detail/point_functions.h"

namespace majorant {

// A formula f(n, q, d). Invariants are in rows n, q, d, one number a point.
struct SolidInvariantFunction {
  const void* formula;
  void (*values)(const void* formula, const PointBatch&, const double* invariants, double* f);
  // Computes rows: the value, the first derivatives, the lower triangle of the second ones.
  void (*jets)(const void* formula, const PointBatch&, const double* invariants, double* jets);
};

// Returns its kernels for the widest instructions of this machine.
DensityKernels solid_invariant_kernels();

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
