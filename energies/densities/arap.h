// As rigid as possible: (Sigma - 1)^2 + (sigma - 1)^2 = |J - R|^2 for the nearest rotation R, 0 at
// isometries. Defined everywhere, no barrier. Convex in (A, B): |J|^2 - 4 A + 2; separable.
// [LZXGG08].
#pragma once

#include "majorant/energies/spectral.h"

namespace majorant {

inline auto arap_density() {
  return invariant("arap",
                   [](const auto& x, const auto& y) {
                     using std::sqrt;
                     return 2.0 * (x + y) - 4.0 * sqrt(x) + 2.0;
                   },
                   {Domain::Everywhere, Convexity::Convex, Reweighting::Separable});
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
