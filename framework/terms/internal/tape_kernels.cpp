#include "majorant/framework/terms/internal/tape_kernels.h"

#ifdef MAJORANT_X86_KERNELS
#include <xsimd/xsimd.hpp>
#endif

namespace majorant::detail {

extern const TapeKernels tape_kernels_baseline;
#ifdef MAJORANT_X86_KERNELS
extern const TapeKernels tape_kernels_avx2, tape_kernels_avx512;
#endif

std::vector<const TapeKernels*> all_tape_kernels() {
  std::vector<const TapeKernels*> all{&tape_kernels_baseline};
#ifdef MAJORANT_X86_KERNELS
  const auto machine = xsimd::available_architectures();
  if (machine.fma3_avx2) all.push_back(&tape_kernels_avx2);
  if (machine.avx512bw) all.push_back(&tape_kernels_avx512);
#endif
  return all;
}

const TapeKernels& tape_kernels() {
  static const TapeKernels& widest = *all_tape_kernels().back();
  return widest;
}

}  // namespace majorant::detail

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
