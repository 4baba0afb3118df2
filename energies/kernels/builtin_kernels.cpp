// This file is compiled once per instruction set (cmake/kernels.cmake names the function), without
// models that are for_comparisons(). It must not instantiate inline code that other files share.
#include "majorant/energies/detail/contraction_kernel.h"
#include "majorant/energies/internal/builtin_densities.h"

namespace majorant {
namespace {

template <class... Energies>
DensityKernels at(int index, const std::tuple<Energies...>*) {
  const DensityKernels table[] = {
      kernel::make_kernels<xsimd::default_arch, typename Energies::Density,
                           kernel::Models::Usual>()...};
  return table[index];
}

}  // namespace

// Returns the kernels of the density with this position in BuiltinEnergies.
DensityKernels MAJORANT_KERNEL_NAME(int index) {
  return at(index, static_cast<const BuiltinEnergies*>(nullptr));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
