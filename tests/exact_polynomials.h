// Exact values of polynomials in Bernstein form, independent of the library except for the order of
// the coefficients.
#pragma once

#include <vector>

#include "majorant/elements/bernstein.h"
#include "random.h"
#include "rational.h"

namespace majorant::test {

inline Rational factorial(int n) { return n < 2 ? Rational(1) : n * factorial(n - 1); }

inline Rational multinomial(const MultiIndex& m) {
  return factorial(m[0] + m[1] + m[2]) / (factorial(m[0]) * factorial(m[1]) * factorial(m[2]));
}

inline Rational power(const Rational& x, int e) {
  return e == 0 ? Rational(1) : x * power(x, e - 1);
}

struct ExactPoint {
  Rational a, b, c;  // barycentric, a + b + c = 1
};

inline ExactPoint exact_point(Random& random, int denominator = 60) {
  const int i = random.integer(0, denominator), j = random.integer(0, denominator - i);
  return {Rational(i, denominator), Rational(j, denominator),
          Rational(denominator - i - j, denominator)};
}

inline Rational evaluate(int n, const std::vector<Rational>& coefficients, const ExactPoint& p) {
  const TriangleIndices& ix = TriangleIndices::of_degree(n);
  Rational sum = 0;
  for (int l = 0; l < ix.count(); ++l) {
    const MultiIndex& m = ix.multi(l);
    sum += coefficients[static_cast<std::size_t>(l)] * multinomial(m) * power(p.a, m[0]) *
           power(p.b, m[1]) * power(p.c, m[2]);
  }
  return sum;
}

// Converts doubles to rationals, which is exact for finite ones.
inline std::vector<Rational> exact(const double* values, int count) {
  return std::vector<Rational>(values, values + count);
}

}  // namespace majorant::test

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
