// Doubles as integers: all numbers are multiplied by one power of two, so that signs of homogeneous
// functions (determinants, Bernstein coefficients) stay those of the doubles.
//
//   using Integer = boost::multiprecision::cpp_int;
//   const std::vector<Integer> scaled = to_integers<Integer>(std::array{0.5, 3.0});  // 1, 6
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <ranges>
#include <vector>

namespace majorant {

// values: finite. Integer: unbounded.
template <class Integer, std::ranges::input_range Values>
std::vector<Integer> to_integers(const Values& values) {
  constexpr int kDigits = std::numeric_limits<double>::digits;
  int lowest = std::numeric_limits<int>::max();
  for (const double x : values)
    if (x != 0) lowest = std::min(lowest, std::ilogb(x));
  std::vector<Integer> out;
  for (const double x : values) {
    const int exponent = x == 0 ? lowest : std::ilogb(x);
    const auto digits = static_cast<std::int64_t>(std::scalbn(x, kDigits - 1 - exponent));
    out.push_back(Integer(digits) << static_cast<unsigned>(exponent - lowest));
  }
  return out;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
