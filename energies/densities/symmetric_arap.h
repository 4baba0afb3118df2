// Symmetric ARAP: |J - R|^2 + |J^-1 - R^-1|^2 = p(Sigma) + p(sigma), p(t) = (t - 1)^2 + (1/t -
// 1)^2, 0 at isometries. A barrier at det J = 0. p'' = 2 + 6/t^4 - 4/t^3 > 0, so convex in (A, B);
// p'(t) (t - 1) = 2 (t - 1)^2 (1 + t^-3) >= 0: separable. [RPPSH17].
#pragma once

#include "majorant/energies/spectral.h"

namespace majorant {

inline auto symmetric_arap_density() {
  return invariant("symmetric-arap",
                   [](const auto& x, const auto& y) {
                     using std::sqrt;
                     const auto det = x - y;  // Sigma + sigma = 2 A, 1/Sigma + 1/sigma = 2 A / det
                     return 2.0 * ((x + y) * (1.0 + 1.0 / (det * det))) -
                            4.0 * (sqrt(x) * (1.0 + 1.0 / det)) + 4.0;
                   },
                   {Domain::PositiveDeterminant, Convexity::Convex, Reweighting::Separable});
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
