// Kernels of formulas of the invariants of volumes, for one instruction set (cmake/kernels.cmake
// names the function). This file must not instantiate inline code that other files share.
#include "majorant/energies/detail/contraction_kernel.h"
#include "majorant/energies/internal/solid_invariant_kernel.h"

namespace majorant {

DensityKernels MAJORANT_KERNEL_NAME() {
  return kernel::make_kernels<xsimd::default_arch, PointwiseSolidInvariant>();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
