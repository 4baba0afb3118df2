// Kernels with a formula compiled into them for SIMD batches, as for the built-in energies. They
// suit an isotropic density that is final and must be fast.
//
//   auto mine = spectral("mine", [](auto S, auto s) { return S / s + s / S; });
//   options.map.energy = {{energy_factory(mine, vectorized(mine))}};
//
// Formulas that branch are not possible. For formulas that still change, use the kernels of the
// library instead: they call any formula point by point, and a file with such a formula compiles in
// a fraction of the time. Here the user's file compiles the whole contraction with its own flags,
// of which -march=native or similar is essential. The formula is called with SIMD batches: no
// branches, no comparisons, no data of elements. docs/energies.md has the gain.
#pragma once

#include "majorant/energies/detail/contraction_kernel.h"
#include "majorant/energies/detail/pointwise.h"

namespace majorant {

// Returns the kernels for make_energy() and energy_factory() with this density. Throws
// InvalidArgument for a spectral() formula that is not symmetric.
template <detail::Isotropic Density>
DensityKernels vectorized(const Density& density) {
  static_assert(
      !requires(const Density& density) { density.element_count(); },
      "formulas with data of elements are called point by point");
  detail::require_symmetric<xsimd::batch<double>>(density);
  return kernel::make_kernels<xsimd::default_arch, Density>();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
