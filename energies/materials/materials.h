// Elastic materials, as densities of the deformation gradient F in 2 (plane strain) and 3
// dimensions; J = det F.
//
//   const auto rubber = stable_neo_hookean<3>(LameConstants::of(1.0, 0.49));
//   builder.add(make_energy(space, rest, rubber), 1.0);
//
// The headers:
//     lame_constants.h            mu and lambda of Young's modulus and Poisson's ratio
//     stable_neo_hookean.h        finite at J <= 0, common for large deformations
//     neo_hookean.h               with log J: a barrier at J = 0
//     fixed_corotated.h           |F - R|^2, finite at J <= 0
//     mooney_rivlin.h, ogden.h    rubber, of two constants and of any number
//     saint_venant_kirchhoff.h    linear in Green's strain; for small strains
//
// For maps of surfaces, use named_energies() (energy_factory.h).
#pragma once

#include "majorant/energies/materials/fixed_corotated.h"
#include "majorant/energies/materials/lame_constants.h"
#include "majorant/energies/materials/mooney_rivlin.h"
#include "majorant/energies/materials/neo_hookean.h"
#include "majorant/energies/materials/ogden.h"
#include "majorant/energies/materials/saint_venant_kirchhoff.h"
#include "majorant/energies/materials/stable_neo_hookean.h"

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
