// Variables, trigonometric and hyperbolic functions of dual numbers; atan2, hypot and the
// elementary ones are in dual2.h, which includes this header. Not for inclusion on its own account.
#pragma once

#include <cmath>

#include "majorant/framework/dual2.h"

namespace majorant {

// The two variables of an isotropic density.
template <class T>
std::array<Dual2<T, 2>, 2> dual2_variables(const T& a, const T& b) {
  return {Dual2<T, 2>::variable(a, 0), Dual2<T, 2>::variable(b, 1)};
}

namespace detail {

// Of asin, without the cancellation of 1 - x^2.
template <class T>
T arc_slope(const T& x) {
  using std::sqrt;
  return T(1.0) / sqrt((T(1.0) - x) * (T(1.0) + x));
}

}  // namespace detail

template <class T, int N, int Order>
Dual<T, N, Order> sin(const Dual<T, N, Order>& a) {
  using std::cos;
  using std::sin;
  const T s = sin(a.v);
  return a.chain(s, cos(a.v), -s);
}

template <class T, int N, int Order>
Dual<T, N, Order> cos(const Dual<T, N, Order>& a) {
  using std::cos;
  using std::sin;
  const T c = cos(a.v);
  return a.chain(c, -sin(a.v), -c);
}

template <class T, int N, int Order>
Dual<T, N, Order> tan(const Dual<T, N, Order>& a) {
  using std::tan;
  const T t = tan(a.v), slope = T(1.0) + t * t;
  return a.chain(t, slope, T(2.0) * t * slope);
}

template <class T, int N, int Order>
Dual<T, N, Order> asin(const Dual<T, N, Order>& a) {
  using std::asin;
  const T slope = detail::arc_slope(a.v);
  return a.chain(asin(a.v), slope, a.v * slope * slope * slope);
}

template <class T, int N, int Order>
Dual<T, N, Order> acos(const Dual<T, N, Order>& a) {
  using std::acos;
  const T slope = detail::arc_slope(a.v);
  return a.chain(acos(a.v), -slope, -(a.v * slope * slope * slope));
}

template <class T, int N, int Order>
Dual<T, N, Order> atan(const Dual<T, N, Order>& a) {
  using std::atan;
  const T slope = T(1.0) / (T(1.0) + a.v * a.v);
  return a.chain(atan(a.v), slope, T(-2.0) * a.v * slope * slope);
}

template <class T, int N, int Order>
Dual<T, N, Order> sinh(const Dual<T, N, Order>& a) {
  using std::cosh;
  using std::sinh;
  const T s = sinh(a.v);
  return a.chain(s, cosh(a.v), s);
}

template <class T, int N, int Order>
Dual<T, N, Order> cosh(const Dual<T, N, Order>& a) {
  using std::cosh;
  using std::sinh;
  const T c = cosh(a.v);
  return a.chain(c, sinh(a.v), c);
}

template <class T, int N, int Order>
Dual<T, N, Order> tanh(const Dual<T, N, Order>& a) {
  using std::tanh;
  const T t = tanh(a.v), slope = T(1.0) - t * t;
  return a.chain(t, slope, T(-2.0) * t * slope);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
