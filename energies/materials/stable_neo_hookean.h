// The stable neo-Hookean material: with I = |F|^2 in space, |F|^2 + 1 in plane strain,
//     mu / 2 (I - 3 - log((I + 1) / 4)) - 3 mu / 4 (J - 1) + lambda / 2 (J - 1)^2,
// 0 and free of stress at rest. Finite everywhere, J <= 0 too: no barrier. [SGK18], who write the
// last two parts as lambda / 2 (J - alpha)^2 with alpha = 1 + 3 mu / (4 lambda).
#pragma once

#include <cmath>

#include "majorant/energies/materials/lame_constants.h"
#include "majorant/energies/solid.h"

namespace majorant {

template <int D>
auto stable_neo_hookean(const LameConstants& c) {
  const auto shape = [mu = c.mu](const auto& F) {
    using std::log;
    const auto I = F.squaredNorm() + (3.0 - D);
    return 0.5 * mu * (I - 3.0 - log(0.25 * (I + 1.0))) - 0.75 * mu * (F.determinant() - 1.0);
  };
  const auto volume = [lambda = c.lambda](const auto& J) {
    return 0.5 * lambda * ((J - 1.0) * (J - 1.0));
  };
  return solid(density<D, D>("stable-neo-hookean", shape, Traits{.domain = Domain::Everywhere}),
               volume);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
