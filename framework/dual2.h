// Second-order forward differentiation in N variables: a value, its gradient and its Hessian.
//
//   auto [S, s] = dual2_variables<double>(1.5, 0.7);
//   auto h = S * S + s * s + 1.0 / (S * S) + 1.0 / (s * s);   // h.v, h.d[i], h.hess(i, j)
//
// What the lambdas of make_term(), density() and spectral() are called with. Inside them write
// `using std::sqrt;` and so on, so that the same code works on doubles. T is double or a SIMD
// batch; comparisons, and with them branches, are for doubles. Small N only (2 for isotropic
// densities, 12 for the corners of a tetrahedron): a product costs 3 N^2 multiplications;
// everything is unrolled, nothing allocates.
//
// At a kink the derivatives are those of one side: abs(x) has slope 1 at 0; min and max take their
// first argument where both are equal; hypot(0, 0) has derivatives 0, a subgradient. Where a
// function has no finite derivative (sqrt at 0, asin at 1, atan2(0, 0)) neither has the result.
#pragma once

#include <array>
#include <cmath>
#include <compare>
#include <cstddef>
#include <type_traits>

namespace majorant {

template <class T, int N>
struct Dual2 {
  static constexpr bool is_scalar = std::is_same_v<T, double>;

  T v;
  std::array<T, N> d;
  std::array<T, N*(N + 1) / 2> h;  // lower triangle, row by row

  Dual2() : v(0.0) { clear(); }
  Dual2(double value) : v(value) { clear(); }
  explicit Dual2(const T& value) requires(!is_scalar) : v(value) { clear(); }
  static Dual2 variable(const T& value, int index) {
    Dual2 x{value};
    x.d[static_cast<std::size_t>(index)] = T(1.0);
    return x;
  }
  const T& hess(int i, int j) const {
    return h[static_cast<std::size_t>(i >= j ? i * (i + 1) / 2 + j : j * (j + 1) / 2 + i)];
  }

  // f(x) given f, f' and f'' at x.v.
  Dual2 chain(const T& f, const T& f1, const T& f2) const {
    Dual2 r(f, Unset{});
    for (std::size_t i = 0, k = 0; i < N; ++i) {
      r.d[i] = f1 * d[i];
      for (std::size_t j = 0; j <= i; ++j, ++k) r.h[k] = f1 * h[k] + f2 * (d[i] * d[j]);
    }
    return r;
  }
  // Value and derivatives of a function of two variables.
  struct Partials {
    T f, fa, fb, faa, fab, fbb;
  };
  static Dual2 chain(const Dual2& a, const Dual2& b, const Partials& p) {
    Dual2 r(p.f, Unset{});
    for (std::size_t i = 0, k = 0; i < N; ++i) {
      r.d[i] = p.fa * a.d[i] + p.fb * b.d[i];
      const T along_a = p.faa * a.d[i] + p.fab * b.d[i], along_b = p.fab * a.d[i] + p.fbb * b.d[i];
      for (std::size_t j = 0; j <= i; ++j, ++k)
        r.h[k] = p.fa * a.h[k] + p.fb * b.h[k] + along_a * a.d[j] + along_b * b.d[j];
    }
    return r;
  }

  Dual2& operator+=(const Dual2& o) {
    v += o.v;
    for (std::size_t i = 0; i < d.size(); ++i) d[i] += o.d[i];
    for (std::size_t k = 0; k < h.size(); ++k) h[k] += o.h[k];
    return *this;
  }
  Dual2& operator-=(const Dual2& o) {
    v -= o.v;
    for (std::size_t i = 0; i < d.size(); ++i) d[i] -= o.d[i];
    for (std::size_t k = 0; k < h.size(); ++k) h[k] -= o.h[k];
    return *this;
  }
  Dual2& operator*=(double c) {
    const T factor(c);
    v *= factor;
    for (auto& x : d) x *= factor;
    for (auto& x : h) x *= factor;
    return *this;
  }
  Dual2& operator+=(double c) {
    v += T(c);
    return *this;
  }
  Dual2& operator-=(double c) {
    v -= T(c);
    return *this;
  }
  Dual2& operator/=(double c) { return *this *= 1.0 / c; }
  Dual2& operator*=(const Dual2& o) { return *this = *this * o; }
  Dual2& operator/=(const Dual2& o) { return *this = *this / o; }

  friend const Dual2& operator+(const Dual2& a) { return a; }
  friend Dual2 operator-(const Dual2& a) { return a * -1.0; }
  friend Dual2 operator+(const Dual2& a, const Dual2& b) {
    Dual2 r(T(a.v + b.v), Unset{});
    for (std::size_t i = 0; i < r.d.size(); ++i) r.d[i] = a.d[i] + b.d[i];
    for (std::size_t k = 0; k < r.h.size(); ++k) r.h[k] = a.h[k] + b.h[k];
    return r;
  }
  friend Dual2 operator-(const Dual2& a, const Dual2& b) {
    Dual2 r(T(a.v - b.v), Unset{});
    for (std::size_t i = 0; i < r.d.size(); ++i) r.d[i] = a.d[i] - b.d[i];
    for (std::size_t k = 0; k < r.h.size(); ++k) r.h[k] = a.h[k] - b.h[k];
    return r;
  }
  friend Dual2 operator*(const Dual2& a, const Dual2& b) {
    Dual2 r(T(a.v * b.v), Unset{});
    for (std::size_t i = 0, k = 0; i < N; ++i) {
      r.d[i] = a.v * b.d[i] + a.d[i] * b.v;
      for (std::size_t j = 0; j <= i; ++j, ++k)
        r.h[k] = (a.v * b.h[k] + a.h[k] * b.v) + (a.d[i] * b.d[j] + a.d[j] * b.d[i]);
    }
    return r;
  }
  friend Dual2 inverse(const Dual2& a) {
    const T i = T(1.0) / a.v, i2 = i * i;
    return a.chain(i, -i2, T(2.0) * i2 * i);
  }
  friend Dual2 operator/(const Dual2& a, const Dual2& b) { return a * inverse(b); }
  friend Dual2 operator+(Dual2 a, double b) { return a += b; }
  friend Dual2 operator+(double b, Dual2 a) { return a += b; }
  friend Dual2 operator-(Dual2 a, double b) { return a -= b; }
  friend Dual2 operator-(double b, const Dual2& a) { return -a + b; }
  friend Dual2 operator*(const Dual2& a, double b) {
    const T factor(b);
    Dual2 r(T(a.v * factor), Unset{});
    for (std::size_t i = 0; i < r.d.size(); ++i) r.d[i] = a.d[i] * factor;
    for (std::size_t k = 0; k < r.h.size(); ++k) r.h[k] = a.h[k] * factor;
    return r;
  }
  friend Dual2 operator*(double b, const Dual2& a) { return a * b; }
  friend Dual2 operator/(const Dual2& a, double b) { return a * (1.0 / b); }
  friend Dual2 operator/(double b, const Dual2& a) { return inverse(a) * b; }

  // Of the values alone.
  friend auto operator<=>(const Dual2& a, const Dual2& b) requires is_scalar { return a.v <=> b.v; }
  friend auto operator<=>(const Dual2& a, double b) requires is_scalar { return a.v <=> b; }
  friend bool operator==(const Dual2& a, const Dual2& b) requires is_scalar { return a.v == b.v; }
  friend bool operator==(const Dual2& a, double b) requires is_scalar { return a.v == b; }

  friend Dual2 sqrt(const Dual2& a) {
    using std::sqrt;
    const T r = sqrt(a.v), i = T(0.5) / r;
    return a.chain(r, i, T(-0.5) * i / a.v);
  }
  friend Dual2 log(const Dual2& a) {
    using std::log;
    const T i = T(1.0) / a.v;
    return a.chain(log(a.v), i, -(i * i));
  }
  friend Dual2 exp(const Dual2& a) {
    using std::exp;
    const T e = exp(a.v);
    return a.chain(e, e, e);
  }

  // Negative bases where the exponent is a whole number, 0 where it is at least 2 (or 0 or 1).
  friend Dual2 pow(const Dual2& a, double p) {
    using std::pow;
    const auto power = [&a](double q) { return T(pow(a.v, T(q))); };
    return a.chain(power(p), p == 0 ? T(0.0) : T(p) * power(p - 1),
                   p == 0 || p == 1 ? T(0.0) : T(p * (p - 1)) * power(p - 2));
  }
  friend Dual2 pow(double a, const Dual2& p) {
    using std::log;
    using std::pow;
    const T f = pow(T(a), p.v), l = a == 0 ? T(0.0) : T(log(T(a)));
    return p.chain(f, l * f, l * l * f);
  }
  // Of positive bases.
  friend Dual2 pow(const Dual2& a, const Dual2& p) {
    using std::log;
    using std::pow;
    const T f = pow(a.v, p.v), l = log(a.v), q = f / a.v, pq = p.v * q;
    return chain(a, p, {f, pq, l * f, (p.v - T(1.0)) * pq / a.v, q + l * pq, l * l * f});
  }

  // The angle of (x, y), in (-pi, pi].
  friend Dual2 atan2(const Dual2& y, const Dual2& x) {
    using std::atan2;
    const T i = T(1.0) / (x.v * x.v + y.v * y.v), c = x.v * i, s = y.v * i;
    const T mixed = s * s - c * c, same = T(2.0) * c * s;
    return chain(y, x, {atan2(y.v, x.v), c, -s, -same, mixed, same});
  }

  // sqrt(a a + b b) without overflow.
  friend Dual2 hypot(const Dual2& a, const Dual2& b) {
    using std::hypot;
    const T r = hypot(a.v, b.v), i = either(r > T(0.0), T(1.0) / r, T(0.0));
    const T c = a.v * i, s = b.v * i;
    return chain(a, b, {r, c, s, s * s * i, -(c * s * i), c * c * i});
  }
  friend Dual2 abs(const Dual2& a) { return either(a.v < T(0.0), -a, a); }
  friend Dual2 fabs(const Dual2& a) { return abs(a); }
  friend Dual2 min(const Dual2& a, const Dual2& b) { return either(b.v < a.v, b, a); }
  friend Dual2 max(const Dual2& a, const Dual2& b) { return either(a.v < b.v, b, a); }

  // With a double in place of one of two arguments.
  friend Dual2 atan2(const Dual2& y, double x) { return atan2(y, Dual2(x)); }
  friend Dual2 atan2(double y, const Dual2& x) { return atan2(Dual2(y), x); }
  friend Dual2 hypot(const Dual2& a, double b) { return hypot(a, Dual2(b)); }
  friend Dual2 hypot(double a, const Dual2& b) { return hypot(Dual2(a), b); }
  friend Dual2 min(const Dual2& a, double b) { return min(a, Dual2(b)); }
  friend Dual2 min(double a, const Dual2& b) { return min(Dual2(a), b); }
  friend Dual2 max(const Dual2& a, double b) { return max(a, Dual2(b)); }
  friend Dual2 max(double a, const Dual2& b) { return max(Dual2(a), b); }

 private:
  struct Unset {};
  Dual2(const T& value, Unset) : v(value) {}  // its derivatives are about to be written
  void clear() {
    d.fill(T(0.0));
    h.fill(T(0.0));
  }
  static const T& either(bool first, const T& a, const T& b) { return first ? a : b; }
  static const Dual2& either(bool first, const Dual2& a, const Dual2& b) { return first ? a : b; }
  template <class Mask>
  static T either(const Mask& first, const T& a, const T& b) requires(!is_scalar) {
    return select(first, a, b);
  }
  template <class Mask>
  static Dual2 either(const Mask& first, const Dual2& a, const Dual2& b) requires(!is_scalar) {
    Dual2 r(select(first, a.v, b.v), Unset{});
    for (std::size_t i = 0; i < r.d.size(); ++i) r.d[i] = select(first, a.d[i], b.d[i]);
    for (std::size_t k = 0; k < r.h.size(); ++k) r.h[k] = select(first, a.h[k], b.h[k]);
    return r;
  }
};

// The two variables of an isotropic density.
template <class T>
std::array<Dual2<T, 2>, 2> dual2_variables(const T& a, const T& b) {
  return {Dual2<T, 2>::variable(a, 0), Dual2<T, 2>::variable(b, 1)};
}

}  // namespace majorant

// Trigonometric and hyperbolic functions.
#include "majorant/framework/dual2_functions.h"

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
