// Bounds of rounding errors in double and quadruple precision.
//
//   const double sum = 0.1 + 0.2;
//   const double error = kUnitRoundoff<double> * magnitude(sum);
#pragma once

#include <cmath>
#include <limits>

namespace majorant {

__extension__ typedef __float128 Float128;

// The error of an operation, relative to the result's magnitude: half the distance from 1 to the
// next number.
template <class Real>
inline constexpr double kUnitRoundoff = std::numeric_limits<Real>::epsilon() / 2;
template <>
inline constexpr double kUnitRoundoff<Float128> = 0x1p-113;  // numeric_limits lacks it in ISO C++

// All integers up to this are doubles.
inline constexpr double kExactIntegers = 1 / kUnitRoundoff<double>;

template <class Real>
Real magnitude(Real a) {
  return a < 0 ? -a : a;
}

// Returns a power of two next to `size` > 0, finite; scaling by it changes no digit. Below: at most
// `size`; Above: at least.
enum class PowerOfTwo { Below, Nearest, Above };
inline double power_of_two(double size, PowerOfTwo which = PowerOfTwo::Below) {
  if (which == PowerOfTwo::Below) return std::ldexp(1.0, std::ilogb(size));
  const double exponent = std::log2(size);
  return std::exp2(which == PowerOfTwo::Above ? std::ceil(exponent) : std::round(exponent));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
