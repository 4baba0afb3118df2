// As similar as possible (least squares conformal): (Sigma - sigma)^2 = 4 |beta|^2, 0 at
// similarities. Defined everywhere, no barrier. It is a convex quadratic function of the control
// points, so its exact Hessian is constant, and the paper's composite majorizer only adds to it
// (method.md E9). Collapses unless a fixed boundary or two pins hold its scale. [LPRM02], [MC20]
// App. B.
#pragma once

#include "majorant/energies/spectral.h"

namespace majorant {

inline auto asap_density() {
  return invariant("asap", [](const auto&, const auto& y) { return 4.0 * y; },
                   {Domain::Everywhere, Convexity::Convex, Reweighting::Refused, Barrier::None,
                    FreeScale::Collapses});
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
