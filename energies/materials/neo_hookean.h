// The compressible neo-Hookean material with a logarithm: with d dimensions,
//     mu / 2 (|F|^2 - d) - mu log J + lambda / 2 log^2 J,
// 0 and free of stress at rest; a barrier at J = 0. [BW08]. Plane strain has the same
// formula. The volume part is not convex beyond J = e.
#pragma once

#include <cmath>

#include "majorant/energies/materials/lame_constants.h"
#include "majorant/energies/solid.h"

namespace majorant {

template <int D>
auto neo_hookean(const LameConstants& c) {
  const auto shape = [mu = c.mu](const auto& F) {
    using std::log;
    return 0.5 * mu * (F.squaredNorm() - D) - mu * log(F.determinant());
  };
  const auto volume = [lambda = c.lambda](const auto& J) {
    using std::log;
    const auto strain = log(J);
    return 0.5 * lambda * (strain * strain);
  };
  return solid(density<D, D>("neo-hookean", shape), volume);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
