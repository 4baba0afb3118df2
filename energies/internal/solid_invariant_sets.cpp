#include "majorant/energies/detail/solid_invariant_function.h"
#include "majorant/energies/internal/instruction_sets.h"

namespace majorant {

DensityKernels solid_invariant_kernels_baseline();
#ifdef MAJORANT_X86_KERNELS
DensityKernels solid_invariant_kernels_avx2();
DensityKernels solid_invariant_kernels_avx512();
#endif

DensityKernels solid_invariant_kernels() {
#ifdef MAJORANT_X86_KERNELS
  const InstructionSet set = widest_instruction_set();
  if (set == InstructionSet::Avx512) return solid_invariant_kernels_avx512();
  if (set == InstructionSet::Avx2) return solid_invariant_kernels_avx2();
#endif
  return solid_invariant_kernels_baseline();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
