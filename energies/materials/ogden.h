// Ogden's material: with the principal stretches s_i, in plane strain a third one of 1,
//     sum_p mu_p / alpha_p (J^(-alpha_p / 3) (s_1^alpha_p + s_2^alpha_p + s_3^alpha_p) - 3)
//     + kappa / 2 (J - 1)^2,
// 0 and free of stress at rest; a barrier at J = 0. Its shear modulus at rest is half the sum of
// mu_p alpha_p, its bulk modulus kappa. [Ogd72], with a shape part that is independent of volume.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "majorant/energies/solid.h"
#include "majorant/energies/stretches.h"

namespace majorant {

struct Ogden {
  struct Summand {
    double mu, alpha;
  };
  std::vector<Summand> summands;
  double kappa = 0;
};

template <int D>
auto ogden(const Ogden& c) {
  const auto shape = [summands = c.summands](const auto& first, const auto&... others) {
    using std::pow;
    const auto J = (first * ... * others);
    auto sum = 0.0 * first;
    for (const Ogden::Summand& p : summands) {
      auto powers = pow(first, p.alpha) + (3.0 - D);
      ((powers = powers + pow(others, p.alpha)), ...);
      sum = sum + p.mu / p.alpha * (pow(J, -p.alpha / 3) * powers - 3.0);
    }
    return sum;
  };
  const auto volume = [kappa = c.kappa](const auto& J) {
    return 0.5 * kappa * ((J - 1.0) * (J - 1.0));
  };
  return solid(stretches<D>("ogden", shape), volume);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
