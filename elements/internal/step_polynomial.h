// Polynomials of degree K in the step t along a line of maps: det J(x + t d) has one per Bernstein
// coefficient, quadratic in the plane and cubic in space.
#pragma once

#include <algorithm>

namespace majorant {

inline double half(double x) { return 0.5 * x; }

template <int K>
struct StepPolynomial {
  double power[K + 1];  // coefficients of 1, t, t^2, ...
};

template <int K>
StepPolynomial<K> operator+(const StepPolynomial<K>& a, const StepPolynomial<K>& b) {
  StepPolynomial<K> out;
  for (int k = 0; k <= K; ++k) out.power[k] = a.power[k] + b.power[k];
  return out;
}

template <int K>
StepPolynomial<K> half(const StepPolynomial<K>& a) {
  StepPolynomial<K> out;
  for (int k = 0; k <= K; ++k) out.power[k] = 0.5 * a.power[k];
  return out;
}

// Returns true if the coefficients alone show p > 0 on [0, s]; false proves nothing.
template <int K>
bool plainly_positive(const StepPolynomial<K>& p, double s) {
  double sum = p.power[0];
  for (int k = 1; k <= K; ++k) {
    double term = std::min(p.power[k], 0.0);  // may be NaN
    for (int j = 0; j < k; ++j) term *= s;
    sum += term;
  }
  return sum > 0;
}

// Returns the first root in (0, s] of p with p(0) > 0, or s if there is none; 0 for NaN. The root
// of a cubic is approached from below, so that p > 0 before it.
double first_root(const StepPolynomial<2>& p, double s);
double first_root(const StepPolynomial<3>& p, double s);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
