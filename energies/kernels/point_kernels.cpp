// Kernels of formulas that are compiled elsewhere, for one instruction set (cmake/kernels.cmake
// names the function). This file must not instantiate inline code that other files share.
#include "majorant/energies/detail/contraction_kernel.h"
#include "majorant/energies/internal/dilatation_kernel.h"
#include "majorant/energies/internal/point_densities.h"

namespace majorant {
namespace {

// Models for comparisons are compiled for the baseline alone.
#ifdef MAJORANT_USUAL_MODELS
constexpr kernel::Models kModels = kernel::Models::Usual;
#else
constexpr kernel::Models kModels = kernel::Models::All;
#endif

template <int M, int D>
DensityKernels of_jacobian() {
  return kernel::make_kernels<xsimd::default_arch, PointwiseJacobian<M, D>, kModels>();
}

}  // namespace

// Returns kernels by index: M by D Jacobians have 3 (M - 1) + D - 1, isotropic planar densities 9,
// solids with a projected dilatation 8 + D.
DensityKernels MAJORANT_KERNEL_NAME(int index) {
  const DensityKernels table[] = {
      of_jacobian<1, 1>(),
      of_jacobian<1, 2>(),
      of_jacobian<1, 3>(),
      of_jacobian<2, 1>(),
      of_jacobian<2, 2>(),
      of_jacobian<2, 3>(),
      of_jacobian<3, 1>(),
      of_jacobian<3, 2>(),
      of_jacobian<3, 3>(),
      kernel::make_kernels<xsimd::default_arch, PointwiseInvariant, kModels>(),
      kernel::make_solid_kernels<xsimd::default_arch, PointwiseSolid<2>>(),
      kernel::make_solid_kernels<xsimd::default_arch, PointwiseSolid<3>>()};
  return table[index];
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
