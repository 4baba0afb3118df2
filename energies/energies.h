// Energies of maps, whole: densities of the Jacobian, from one line of code or by name, and the
// terms that they become. Not for energies that are not of a Jacobian: terms/terms.h.
//
//   auto mine = spectral("mine", [](auto S, auto s) { return S / s + s / S; });
//   builder.add(make_energy(space, rest, mine), 1.0);
//
// Its headers:
//     named_energies.h            those that the library ships
//     spectral.h                  isotropic densities: spectral(), invariant()
//     density.h                   any density of J, of 1 to 3 rows and columns
//     element_data.h              formulas that are told of their element
//     traits.h                    what a density declares of itself
//     make_energy.h               from a density to a term, or to an EnergyFactory
//     energy_factory.h            EnergyFactory, EnergySum: what drivers take
//     density_term.h              DensityTerm: the term of a density
//
// Not here, since it compiles the whole contraction: vectorized.h, for a formula that is waited
// for.
#pragma once

#include "majorant/energies/density.h"
#include "majorant/energies/density_term.h"
#include "majorant/energies/element_data.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/energies/make_energy.h"
#include "majorant/energies/named_energies.h"
#include "majorant/energies/spectral.h"
#include "majorant/energies/traits.h"

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
