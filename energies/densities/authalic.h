// Authalic: det J + 1 / det J, 2 where areas are preserved. A barrier at det J = 0. It ignores
// angles, so its minima are far from unique and it should be combined with another energy. Not
// convex in (A, B), not separable. [FLG15] (their E_det, doubled).
#pragma once

#include "majorant/energies/spectral.h"

namespace majorant {

inline auto authalic_density() {
  return invariant("authalic",
                   [](const auto& x, const auto& y) {
                     const auto det = x - y;
                     return det + 1.0 / det;
                   },
                   {Domain::PositiveDeterminant, Convexity::Unknown, Reweighting::Refused});
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
