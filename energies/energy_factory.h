// Energies that can be put on any space and rules: what drivers take as "the energy".
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "majorant/energies/density_term.h"

namespace majorant {

// Value of the term = sum over elements of measure * mean density. Made by energy_factory() of
// make_energy.h, or taken from named_energies.h.
using EnergyFactory = std::function<std::shared_ptr<const DensityTerm>(
    std::shared_ptr<const ElementSpace> space, const RestShapes& rest,
    const std::vector<Quadrature>& rules)>;

// sum of weight * energy.
struct WeightedEnergy {
  EnergyFactory make;
  double weight = 1.0;
};
using EnergySum = std::vector<WeightedEnergy>;

}  // namespace majorant
