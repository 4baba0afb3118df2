#include "majorant/energies/symmetric_dirichlet.h"

#include "majorant/energies/make_energy.h"

namespace majorant {

#ifdef MAJORANT_X86_KERNELS
DensityKernels symmetric_dirichlet_kernels_avx2();
DensityKernels symmetric_dirichlet_kernels_avx512();
#endif

namespace {

using Density = decltype(symmetric_dirichlet_density());

DensityKernels best_kernels() {
#ifdef MAJORANT_X86_KERNELS
  const auto machine = xsimd::available_architectures();
  if (machine.avx512bw) return symmetric_dirichlet_kernels_avx512();
  if (machine.fma3_avx2) return symmetric_dirichlet_kernels_avx2();
#endif
  return kernel::make_kernels<xsimd::default_arch, Density>();
}

}  // namespace

std::shared_ptr<const DensityTerm> make_symmetric_dirichlet(
    std::shared_ptr<const ElementSpace> space, const RestShapes& rest,
    const std::vector<Quadrature>& rules) {
  return std::make_shared<const DensityTerm>(
      "symmetric-dirichlet", std::move(space), rest, rules,
      std::make_shared<const Density>(symmetric_dirichlet_density()), best_kernels());
}

}  // namespace majorant
