// An energy that can be put on any space and rules: what drivers take as "the energy".
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "majorant/energies/density_term.h"

namespace majorant {

// Value of the term = sum over elements of measure * mean density. Example:
// make_symmetric_dirichlet.
using EnergyFactory = std::function<std::shared_ptr<const DensityTerm>(
    std::shared_ptr<const ElementSpace> space, const RestShapes& rest,
    const std::vector<Quadrature>& rules)>;

}  // namespace majorant
