// Energies of maps: densities of the Jacobian, from one line of code or by name, and their terms.
//
//   auto mine = spectral("mine", [](auto S, auto s) { return S / s + s / S; });
//   builder.add(make_energy(space, rest, mine), 1.0);
//
// The headers:
//     make_energy.h               from a density to a term, or to an EnergyFactory: density(), any
//                                 function of J; formulas with data of their element
//     spectral.h                  isotropic densities: spectral(), invariant()
//     traits.h                    the properties that a density declares
//     energy_factory.h            EnergyFactory, EnergySum: what drivers take; energies by name
//
// vectorized.h, which compiles the whole contraction to make a formula faster, is not included
// here. Energies that are not densities of a Jacobian are in framework/terms/terms.h.
#pragma once

#include "majorant/energies/energy_factory.h"
#include "majorant/energies/make_energy.h"
#include "majorant/energies/spectral.h"
#include "majorant/energies/traits.h"

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
