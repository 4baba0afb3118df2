// The symmetric Dirichlet energy as a term; the density is in symmetric_dirichlet_density.h.
#pragma once

#include "majorant/energies/density_term.h"
#include "majorant/energies/symmetric_dirichlet_density.h"

namespace majorant {

// make_energy() with kernels for several instruction sets, chosen at run time.
std::shared_ptr<const DensityTerm> make_symmetric_dirichlet(
    std::shared_ptr<const ElementSpace> space, const RestShapes& rest,
    const std::vector<Quadrature>& rules);

}  // namespace majorant
