// Compiled once per instruction set (energies/CMakeLists in the root: MAJORANT_KERNEL_SET). Nothing
// here may instantiate inline code that other files share.
#include "majorant/energies/contraction_kernel.h"
#include "majorant/energies/symmetric_dirichlet_density.h"

namespace majorant {

DensityKernels MAJORANT_KERNEL_NAME() {
  return kernel::make_kernels<xsimd::default_arch, decltype(symmetric_dirichlet_density())>();
}

}  // namespace majorant
