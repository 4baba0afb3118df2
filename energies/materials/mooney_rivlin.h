// The Mooney-Rivlin material: with C = F^T F, in plane strain with a third stretch of 1,
//     a (J^(-2/3) I1 - 3) + b (J^(-4/3) I2 - 3) + kappa / 2 (J - 1)^2,
//     I1 = tr C,  I2 = (tr(C)^2 - |C|^2) / 2,
// 0 and free of stress at rest; a barrier at J = 0. Its shear modulus at rest is 2 (a + b), its
// bulk modulus kappa. [BW08]; it is a special case of [Ogd72].
#pragma once

#include <cmath>

#include "majorant/energies/solid.h"

namespace majorant {

struct MooneyRivlin {
  double a = 0, b = 0, kappa = 0;
};

template <int D>
auto mooney_rivlin(const MooneyRivlin& c) {
  const auto shape = [c](const auto& F) {
    using std::pow;
    const auto C = F.transpose() * F;
    const auto plane = C.trace();  // of the D dimensions
    const auto I1 = plane + (3.0 - D);
    const auto I2 = 0.5 * (plane * plane - C.squaredNorm()) + (3.0 - D) * plane;
    const auto scale = pow(F.determinant(), -2.0 / 3);
    return c.a * (scale * I1 - 3.0) + c.b * (scale * scale * I2 - 3.0);
  };
  const auto volume = [kappa = c.kappa](const auto& J) {
    return 0.5 * kappa * ((J - 1.0) * (J - 1.0));
  };
  return solid(density<D, D>("mooney-rivlin", shape), volume);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
