#include "majorant/energies/internal/instruction_sets.h"
#include "majorant/energies/internal/point_densities.h"
#include "majorant/framework/error.h"

namespace majorant {

DensityKernels point_kernels_baseline(int index);
#ifdef MAJORANT_X86_KERNELS
DensityKernels point_kernels_avx2(int index);
DensityKernels point_kernels_avx512(int index);
#endif

namespace {

DensityKernels point_kernels(int index) {
  const DensityKernels baseline = point_kernels_baseline(index);
#ifdef MAJORANT_X86_KERNELS
  const InstructionSet set = widest_instruction_set();
  if (set == InstructionSet::Baseline) return baseline;
  DensityKernels kernels =
      set == InstructionSet::Avx512 ? point_kernels_avx512(index) : point_kernels_avx2(index);
  kernels.local_of_comparisons = baseline.local;
  return kernels;
#else
  return baseline;
#endif
}

}  // namespace

DensityKernels jacobian_kernels(int rows, int dims) {
  if (rows < 1 || rows > 3 || dims < 1 || dims > 3)
    throw InvalidArgument("jacobian_kernels: a Jacobian has 1 to 3 rows and columns");
  return point_kernels(3 * (rows - 1) + dims - 1);
}

DensityKernels invariant_kernels() { return point_kernels(9); }

DensityKernels solid_kernels(int dims) {
  if (dims < 2 || dims > 3) throw InvalidArgument("solid_kernels: a solid has 2 or 3 dimensions");
  return point_kernels(8 + dims);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
