#include "majorant/elements/internal/step_polynomial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace majorant {
namespace {

constexpr double kNone = 2;  // beyond [0, 1]

// Returns the first root, from below, of the cubic with these control values on [left, left +
// width]. Bisects as long as they are not all positive; `levels` bounds the bisections near a root
// at 0.
double first_root_in(const std::array<double, 4>& b, double left, double width, int levels) {
  if (b[0] > 0 && b[1] > 0 && b[2] > 0 && b[3] > 0) return kNone;
  if (levels == 0 || !(width > std::numeric_limits<double>::epsilon() * left)) return left;
  const double m01 = half(b[0] + b[1]), m12 = half(b[1] + b[2]), m23 = half(b[2] + b[3]);
  const double m012 = half(m01 + m12), m123 = half(m12 + m23), middle = half(m012 + m123);
  const double root = first_root_in({b[0], m01, m012, middle}, left, half(width), levels - 1);
  if (root != kNone) return root;
  return first_root_in({middle, m123, m23, b[3]}, left + half(width), half(width), levels - 1);
}

// Returns the polynomial, times a power of two if squares of its coefficients would leave the range
// of doubles.
StepPolynomial<2> moderate(const StepPolynomial<2>& p) {
  constexpr double kLarge = 0x1p480;
  const double size = std::max({std::abs(p.power[0]), std::abs(p.power[1]), std::abs(p.power[2])});
  if (size > 1 / kLarge && size < kLarge) return p;
  const int exponent = size > 0 && std::isfinite(size) ? std::ilogb(size) : 0;
  StepPolynomial<2> out;
  for (int k = 0; k <= 2; ++k) out.power[k] = std::ldexp(p.power[k], -exponent);
  return out;
}

}  // namespace

double first_root(const StepPolynomial<2>& p, double s) {
  if (plainly_positive(p, s)) return s;
  const auto [a, b, c] = moderate(p).power;
  const double discriminant = b * b - 4 * a * c;
  if (!(discriminant >= 0)) return discriminant < 0 ? s : 0;
  const double root = std::sqrt(discriminant);
  // This is the smaller positive root in the form without cancellation. If b > 0, then c < 0 here.
  if (b > 0) return std::min(s, (b + root) / (-2 * c));
  const double denominator = root - b;
  if (!(denominator > 0)) return s;
  return std::min(s, 2 * a / denominator);
}

double first_root(const StepPolynomial<3>& p, double s) {
  // Upper bound on the bisections of an interval, far beyond the digits of a double.
  constexpr int kMaxLevels = 200;
  if (plainly_positive(p, s)) return s;
  const double q1 = p.power[1] * s, q2 = p.power[2] * s * s, q3 = p.power[3] * s * s * s;
  const double a = p.power[0];
  const std::array<double, 4> b{a, a + q1 / 3, a + (2 * q1 + q2) / 3, a + q1 + q2 + q3};
  if (!std::isfinite(b[0] + b[1] + b[2] + b[3])) return 0;
  return std::min(1.0, first_root_in(b, 0, 1, kMaxLevels)) * s;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
