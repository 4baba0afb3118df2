// Log-isometric (Hencky strain): log^2 Sigma + log^2 sigma, 0 at isometries, the squared distance
// to the rotations in the geodesic metric. A weak barrier at det J = 0. Not convex (log^2 t is
// concave beyond t = e); separable: p'(t) (t - 1) = 2 log t (t - 1) / t >= 0. [Hen28].
#pragma once

#include "majorant/energies/spectral.h"

namespace majorant {

inline auto log_isometric_density() {
  return spectral("log-isometric",
                  [](const auto& S, const auto& s) {
                    using std::log;
                    return log(S) * log(S) + log(s) * log(s);
                  },
                  {Domain::PositiveDeterminant, Convexity::Unknown, Reweighting::Separable});
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
