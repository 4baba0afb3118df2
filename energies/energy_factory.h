// Energies that can be put on any space and rules: what drivers take as "the energy".
//
//   const EnergySum sum{{mips(), 1.0}, {symmetric_dirichlet(), 0.1}};
//   const bool has_a_scale = free_scale_of(sum) == FreeScale::Determined;   // true
#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "majorant/energies/density_term.h"

namespace majorant {

// Made by energy_factory() of make_energy.h, or taken from named_energies.h.
class EnergyFactory {
 public:
  using Make = std::function<std::shared_ptr<const DensityTerm>(
      std::shared_ptr<const ElementSpace> space, const RestShapes& rest,
      const std::vector<Quadrature>& rules)>;
  // make: gives terms of these traits. Throws InvalidArgument where it is empty.
  EnergyFactory(DensityTraits traits, Make make);

  const DensityTraits& traits() const { return traits_; }
  // Value of the term = sum over elements of measure * mean density. Throws InvalidArgument
  // as DensityTerm does.
  std::shared_ptr<const DensityTerm> operator()(std::shared_ptr<const ElementSpace> space,
                                                const RestShapes& rest,
                                                const std::vector<Quadrature>& rules) const {
    return make_(std::move(space), rest, rules);
  }

 private:
  DensityTraits traits_;
  Make make_;
};

// sum of weight * energy.
struct WeightedEnergy {
  EnergyFactory make;
  double weight = 1.0;
};
using EnergySum = std::vector<WeightedEnergy>;

// The strongest of the summands; None of an empty sum.
Barrier barrier_of(const EnergySum& energy);
// Determined if one summand is, else Collapses if one does, else Arbitrary: one scale is enough,
// and nothing but a scale withstands a summand that shrinks the map.
FreeScale free_scale_of(const EnergySum& energy);

}  // namespace majorant
