// Most isometric parametrization, E_conf: |J|^2 / det J = Sigma/sigma + sigma/Sigma, 2 at
// similarities of any scale. A barrier at det J = 0. Not convex in (A, B), so the paper's composite
// majorizer does not apply; |J|^2 over the linearised determinant gives the majorant (2 F / det^2)
// |d alpha|^2 (method.md E10, section 3). Not separable. [HG00], [MC20] Eq. 14.
#pragma once

#include "majorant/energies/spectral.h"

namespace majorant {

inline auto mips_density() {
  return invariant(
      "mips", [](const auto& x, const auto& y) { return 2.0 * ((x + y) / (x - y)); },
      {Domain::PositiveDeterminant, Convexity::Unknown, Reweighting::Refused, Barrier::Weak,
       FreeScale::Arbitrary},
      [](const auto& x, const auto& y) { return 4.0 * ((x + y) / ((x - y) * (x - y))); });
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
