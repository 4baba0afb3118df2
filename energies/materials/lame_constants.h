// The constants of an isotropic elastic material.
//
//   const LameConstants steel = LameConstants::of(210e9, 0.3);   // Young's modulus, Poisson's ratio
#pragma once

#include "majorant/framework/error.h"

namespace majorant {

struct LameConstants {
  double mu = 0, lambda = 0;
  // Throws InvalidArgument unless young > 0 and -1 < poisson < 1/2.
  static LameConstants of(double young, double poisson) {
    if (!(young > 0) || !(poisson > -1) || !(poisson < 0.5))
      throw InvalidArgument("LameConstants: Young's modulus > 0, Poisson's ratio in (-1, 1/2)");
    return {young / (2 * (1 + poisson)), young * poisson / ((1 + poisson) * (1 - 2 * poisson))};
  }
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
