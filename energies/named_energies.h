// The energies users call by name.
//
//   const NamedEnergy* e = find_energy("arap");
//   options.map.energy = {{e->make, 1.0}, {symmetric_dirichlet(), 0.1}};
//
// Kernels are compiled for several instruction sets and chosen at run time.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "majorant/energies/energy_factory.h"

namespace majorant {

// What a free boundary does: energies that vanish as the scale of the map does need something that
// holds it.
enum class FreeScale { Determined, Arbitrary, Collapses };

struct NamedEnergy {
  std::string name;
  std::string summary;  // one line, formula first
  FreeScale free_scale;
  EnergyFactory make;
};

std::span<const NamedEnergy> named_energies();
const NamedEnergy* find_energy(std::string_view name);  // null when there is none

EnergyFactory symmetric_dirichlet();

}  // namespace majorant
