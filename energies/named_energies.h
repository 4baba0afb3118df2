// The energies users call by name.
//
//   const NamedEnergy* e = find_energy("arap");
//   options.map.energy = {{e->make, 1.0}, {mips(), 0.1}};
//
// Kernels are compiled for several instruction sets and chosen at run time.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "majorant/energies/energy_factory.h"

namespace majorant {

struct NamedEnergy {
  std::string name;
  std::string summary;  // one line: formula; where it is smallest, and how small
  EnergyFactory make;   // its traits() say what else is known
};

std::span<const NamedEnergy> named_energies();
const NamedEnergy* find_energy(std::string_view name);  // null when there is none

// Those that code asks for.
EnergyFactory symmetric_dirichlet();
EnergyFactory mips();

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
