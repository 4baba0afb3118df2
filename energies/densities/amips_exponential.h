// Exponential AMIPS: exp(s ((mips + authalic) / 4 - 1)), s = 5, 1 at isometries; it penalizes the
// worst places. A barrier at det J = 0 that overflows early. Not known to be convex, not separable.
// [FLG15] Sec. 3.3 over its minimum e^s.
#pragma once

#include "majorant/energies/spectral.h"

namespace majorant {

inline auto amips_exponential_density() {
  return invariant("amips-exponential",
                   [](const auto& x, const auto& y) {
                     using std::exp;
                     const auto det = x - y;
                     const auto exponent = 0.25 * (2.0 * ((x + y) / det) + det + 1.0 / det) - 1.0;
                     return exp(5.0 * exponent);
                   },
                   {Domain::PositiveDeterminant, Convexity::Unknown, Reweighting::Refused});
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
