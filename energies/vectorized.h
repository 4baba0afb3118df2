// Kernels with a formula compiled into them, for batches of numbers: the way of the built-in
// energies, for an isotropic density that has proven itself and is waited for.
//
//   auto mine = spectral("mine", [](auto S, auto s) { return S / s + s / S; });
//   options.map.energy = {{energy_factory(mine, vectorized(mine))}};
//
// Not for formulas that are still being written, or that branch: the kernels of the library call
// any formula point by point, and the file that has it compiles in a fraction of the time. Here the
// file that asks compiles the whole contraction, with that file's flags: -march=native or the like
// makes the difference. The formula sees SIMD batches: no branches, no comparisons; no data of
// elements. What is gained: docs/energies.md.
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
