#include "number.h"

namespace majorant::hock_schittkowski {

Number& Number::operator+=(const Number& o) {
  dual += o.dual;
  return *this;
}
Number& Number::operator-=(const Number& o) {
  dual -= o.dual;
  return *this;
}
Number operator-(const Number& a) { return Number(-a.dual); }
Number operator+(const Number& a, const Number& b) { return Number(a.dual + b.dual); }
Number operator-(const Number& a, const Number& b) { return Number(a.dual - b.dual); }
Number operator*(const Number& a, const Number& b) { return Number(a.dual * b.dual); }
Number operator/(const Number& a, const Number& b) { return Number(a.dual / b.dual); }
Number operator*(double a, const Number& b) { return Number(a * b.dual); }
Number sqrt(const Number& a) { return Number(sqrt(a.dual)); }
Number exp(const Number& a) { return Number(exp(a.dual)); }
Number log(const Number& a) { return Number(log(a.dual)); }
Number sin(const Number& a) { return Number(sin(a.dual)); }
Number cos(const Number& a) { return Number(cos(a.dual)); }
Number pow(const Number& a, double exponent) { return Number(pow(a.dual, exponent)); }
Number square(const Number& a) { return a * a; }
Number cube(const Number& a) { return a * a * a; }
Number power(const Number& a, int exponent) {
  Number result = a;
  for (int k = 1; k < exponent; ++k) result = result * a;
  return result;
}

}  // namespace majorant::hock_schittkowski

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
