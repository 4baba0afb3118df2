// The material of Saint Venant and Kirchhoff: with the strain E = (F^T F - 1) / 2,
//     mu |E|^2 + lambda / 2 tr(E)^2,
// 0 and free of stress at rest. Finite everywhere and soft under pressure: it does not resist
// inversion. [BW08]. Plane strain has the same formula. It is no SolidDensity: its second part is
// no function of J, so its dilatation cannot be projected.
#pragma once

#include "majorant/energies/make_energy.h"
#include "majorant/energies/materials/lame_constants.h"

namespace majorant {

template <int D>
auto saint_venant_kirchhoff(const LameConstants& c) {
  const auto formula = [c](const auto& F) {
    const auto C = F.transpose() * F;
    const auto trace = 0.5 * (C.trace() - D);
    // |C - 1|^2 = |C|^2 - 2 tr C + d
    const auto strain = 0.25 * (C.squaredNorm() - 2.0 * C.trace() + D);
    return c.mu * strain + 0.5 * c.lambda * (trace * trace);
  };
  return density<D, D>("saint-venant-kirchhoff", formula, Traits{.domain = Domain::Everywhere});
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
