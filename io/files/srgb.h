// Conversions between codes of colours in files, sRGB of IEC 61966-2-1, and linear light, both from
// 0 to 1.
//
//   const double light = srgb_to_linear(188 / 255.0);   // 0.503
#pragma once

#include <cmath>

namespace majorant {

template <class Real>
Real srgb_to_linear(Real code) {
  return code <= Real(0.04045) ? code / Real(12.92)
                               : std::pow((code + Real(0.055)) / Real(1.055), Real(2.4));
}

template <class Real>
Real linear_to_srgb(Real light) {
  return light <= Real(0.0031308) ? light * Real(12.92)
                                  : Real(1.055) * std::pow(light, 1 / Real(2.4)) - Real(0.055);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
