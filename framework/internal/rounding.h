// What a rounded operation may be off: the arithmetic of error bounds, in double and quadruple
// precision.
//
//   const double sum = 0.1 + 0.2;
//   const double error = kUnitRoundoff<double> * magnitude(sum);
#pragma once

#include <limits>

namespace majorant {

__extension__ typedef __float128 Quad;

// Of the result's magnitude: half the distance from 1 to the next number.
template <class Real>
inline constexpr double kUnitRoundoff = std::numeric_limits<Real>::epsilon() / 2;
template <>
inline constexpr double kUnitRoundoff<Quad> =
    0x1p-113;  // numeric_limits does not know it in ISO C++

// Integers up to this are doubles.
inline constexpr double kExactIntegers = 1 / kUnitRoundoff<double>;

template <class Real>
Real magnitude(Real a) {
  return a < 0 ? -a : a;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
