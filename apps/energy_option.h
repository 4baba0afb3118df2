// --energy: the name of an energy, by default of maps, or a weighted sum of energies.
//
//   options.map.energy = parse_energy("symmetric-dirichlet + 0.1*asap");
#pragma once

#include <span>
#include <string>

#include "majorant/energies/energy_factory.h"

namespace majorant::app {

// Parses summands [number *] name, joined by +; spaces are ignored. Throws Error(Usage) that lists
// the names if one is unknown, and for unusable weights (map_problem.h).
EnergySum parse_energy(const std::string& expression,
                       std::span<const NamedEnergy> energies = named_energies());

// Returns lines "name  formula; facts" for --help.
std::string energy_help(std::span<const NamedEnergy> energies = named_energies());

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
