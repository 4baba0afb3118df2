// --energy: a named energy, of maps unless others are given, or a weighted sum of them.
//
//   options.map.energy = parse_energy("symmetric-dirichlet + 0.1*asap");
#pragma once

#include <span>
#include <string>

#include "majorant/energies/energy_factory.h"

namespace majorant::app {

// summands [number *] name, joined by +; space does not matter. Throws Error(Usage) that lists the
// names when one is unknown, and for weights that are no usable numbers (map_problem.h).
EnergySum parse_energy(const std::string& expression,
                       std::span<const NamedEnergy> energies = named_energies());

// "name  formula; facts" lines for --help.
std::string energy_help(std::span<const NamedEnergy> energies = named_energies());

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
