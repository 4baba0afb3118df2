// A number with derivatives by up to kMostUnknowns unknowns. All formulas of the collection use
// this type, so that its operators are compiled once; a generic lambda is compiled for each
// problem.
#pragma once

#include <vector>

#include "majorant/framework/dual2.h"

namespace majorant::hock_schittkowski {

inline constexpr int kMostUnknowns = 16;

struct Number {
  using Dual = Dual2<double, kMostUnknowns>;

  Number(double value = 0) : dual(value) {}
  explicit Number(const Dual& d) : dual(d) {}
  Number& operator+=(const Number& o);
  Number& operator-=(const Number& o);

  Dual dual;
};

Number operator-(const Number& a);
Number operator+(const Number& a, const Number& b);
Number operator-(const Number& a, const Number& b);
Number operator*(const Number& a, const Number& b);
Number operator/(const Number& a, const Number& b);
Number operator*(double a, const Number& b);
Number sqrt(const Number& a);
Number exp(const Number& a);
Number log(const Number& a);
Number sin(const Number& a);
Number cos(const Number& a);
Number pow(const Number& a, double exponent);
Number square(const Number& a);
Number cube(const Number& a);
Number power(const Number& a, int exponent);

// The unknowns of a problem, and the values of several functions.
using Unknowns = std::vector<Number>;
using Values = std::vector<Number>;

}  // namespace majorant::hock_schittkowski

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
