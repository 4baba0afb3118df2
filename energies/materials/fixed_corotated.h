// The fixed corotated material: with the nearest rotation R of F and d dimensions,
//     mu |F - R|^2 + lambda / 2 (J - 1)^2,
// 0 and free of stress at rest. Finite everywhere, no barrier. It has kinks where two singular
// values cancel, at strongly inverted states. [SHTS12]. Plane strain has the same formula.
#pragma once

#include "majorant/energies/materials/lame_constants.h"
#include "majorant/energies/solid.h"
#include "majorant/energies/stretches.h"

namespace majorant {

template <int D>
auto fixed_corotated(const LameConstants& c) {
  const auto shape = [mu = c.mu](const auto& s) { return mu * ((s - 1.0) * (s - 1.0)); };
  const auto volume = [lambda = c.lambda](const auto& J) {
    return 0.5 * lambda * ((J - 1.0) * (J - 1.0));
  };
  return solid(stretches<D>("fixed-corotated", shape, Traits{.domain = Domain::Everywhere}),
               volume);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
