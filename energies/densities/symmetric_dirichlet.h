// Symmetric Dirichlet: |J|^2 + |J^-1|^2 = Sigma^2 + sigma^2 + Sigma^-2 + sigma^-2, 4 at isometries.
// A barrier at det J = 0. Convex in (A, B); separable. [SS15], [MC20] Eq. 7.
#pragma once

#include "majorant/energies/spectral.h"

namespace majorant {

inline auto symmetric_dirichlet_density() {
  return invariant(
      "symmetric-dirichlet",
      [](const auto& x, const auto& y) {
        const auto det = x - y;
        return 2.0 * ((x + y) * (1.0 + 1.0 / (det * det)));
      },
      {Domain::PositiveDeterminant, Convexity::Convex, Reweighting::Separable, Barrier::Strong});
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
