// The energies of volumes that users call by name: those of named_energies() whose formulas also
// apply in three dimensions.
//
//   const NamedEnergy* e = find_solid_energy("mips");
//   builder.add(e->make(space, rest), 1 / rest.measure.sum());
//
// Their densities are density<3, 3> (make_energy.h) or stretches<3> (stretches.h).
#pragma once

#include <span>
#include <string_view>

#include "majorant/energies/energy_factory.h"

namespace majorant {

std::span<const NamedEnergy> solid_energies();
const NamedEnergy* find_solid_energy(std::string_view name);  // null when there is none

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
