#include "majorant/framework/internal/front_kernels.h"

#ifdef MAJORANT_X86_KERNELS
#include <xsimd/xsimd.hpp>
#endif

namespace majorant {

extern const FrontKernels front_kernels_baseline;
#ifdef MAJORANT_X86_KERNELS
extern const FrontKernels front_kernels_avx2, front_kernels_avx512;
#endif

std::vector<const FrontKernels*> all_front_kernels() {
  std::vector<const FrontKernels*> all{&front_kernels_baseline};
#ifdef MAJORANT_X86_KERNELS
  const auto machine = xsimd::available_architectures();
  if (machine.fma3_avx2) all.push_back(&front_kernels_avx2);
  if (machine.avx512bw) all.push_back(&front_kernels_avx512);
#endif
  return all;
}

const FrontKernels& front_kernels() {
  static const FrontKernels& widest = *all_front_kernels().back();
  return widest;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
