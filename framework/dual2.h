// Forward differentiation in N variables: a value, its gradient and, of second order, its Hessian.
//
//   auto [S, s] = dual2_variables<double>(1.5, 0.7);
//   auto h = S * S + s * s + 1.0 / (S * S) + 1.0 / (s * s);   // h.v, h.d[i], h.hess(i, j)
//
// The lambdas of make_term(), density() and spectral() are called with these numbers: Dual2 for a
// Hessian, Dual1 for a gradient alone (make_term, density). Write `using std::sqrt;` and so on
// inside them, so that the same code works on doubles. T is double or a SIMD batch; only doubles
// can be compared, so only they can branch. Small N only (2 for isotropic densities, 12 for the
// corners of a tetrahedron): a product costs 2 N multiplications in the first order, 3 N^2 in the
// second; everything is unrolled, nothing allocates.
//
// At a kink the derivatives are those of one side: abs(x) has slope 1 at 0; min and max take their
// first argument where both are equal; hypot(0, 0) has derivatives 0, a subgradient. Where a
// function has no finite derivative (sqrt at 0, asin at 1, atan2(0, 0)) neither has the result.
//
// Not for functions of many variables: write a term as a sum of functions of few variables each,
// differentiated element by element (framework/terms/local_term.h).
#pragma once

#include <array>
#include <cmath>
#include <compare>
#include <cstddef>
#include <type_traits>

namespace majorant {

template <class T, int N, int Order>  // 1 or 2
struct Dual {
  static constexpr bool is_scalar = std::is_same_v<T, double>;
  static constexpr int order = Order;

  T v;
  std::array<T, N> d;
  std::array<T, Order == 2 ? N*(N + 1) / 2 : 0> h;  // lower triangle, row by row

  Dual() : v(0.0) { clear(); }
  Dual(double value) : v(value) { clear(); }
  explicit Dual(const T& value) requires(!is_scalar) : v(value) { clear(); }
  static Dual variable(const T& value, int index) {
    Dual x{value};
    x.d[static_cast<std::size_t>(index)] = T(1.0);
    return x;
  }
  const T& hess(int i, int j) const requires(Order == 2) {
    return h[static_cast<std::size_t>(i >= j ? i * (i + 1) / 2 + j : j * (j + 1) / 2 + i)];
  }

  // Returns f(x) from f, f' and f'' at x.v.
  Dual chain(const T& f, const T& f1, const T& f2) const {
    Dual r(f, Unset{});
    for (std::size_t i = 0, k = 0; i < N; ++i) {
      r.d[i] = f1 * d[i];
      if constexpr (Order == 2)
        for (std::size_t j = 0; j <= i; ++j, ++k) r.h[k] = f1 * h[k] + f2 * (d[i] * d[j]);
    }
    return r;
  }
  // Value and derivatives of a function of two variables.
  struct Partials {
    T f, fa, fb, faa, fab, fbb;
  };
  static Dual chain(const Dual& a, const Dual& b, const Partials& p) {
    Dual r(p.f, Unset{});
    for (std::size_t i = 0, k = 0; i < N; ++i) {
      r.d[i] = p.fa * a.d[i] + p.fb * b.d[i];
      if constexpr (Order == 2) {
        const T along_a = p.faa * a.d[i] + p.fab * b.d[i];
        const T along_b = p.fab * a.d[i] + p.fbb * b.d[i];
        for (std::size_t j = 0; j <= i; ++j, ++k)
          r.h[k] = p.fa * a.h[k] + p.fb * b.h[k] + along_a * a.d[j] + along_b * b.d[j];
      }
    }
    return r;
  }

  Dual& operator+=(const Dual& o) {
    v += o.v;
    for (std::size_t i = 0; i < d.size(); ++i) d[i] += o.d[i];
    for (std::size_t k = 0; k != h.size(); ++k) h[k] += o.h[k];
    return *this;
  }
  Dual& operator-=(const Dual& o) {
    v -= o.v;
    for (std::size_t i = 0; i < d.size(); ++i) d[i] -= o.d[i];
    for (std::size_t k = 0; k != h.size(); ++k) h[k] -= o.h[k];
    return *this;
  }
  Dual& operator+=(double c) {
    v += T(c);
    return *this;
  }
  Dual& operator-=(double c) {
    v -= T(c);
    return *this;
  }
  Dual& operator*=(double c) { return *this = *this * c; }
  Dual& operator/=(double c) { return *this *= 1.0 / c; }
  Dual& operator*=(const Dual& o) { return *this = *this * o; }
  Dual& operator/=(const Dual& o) { return *this = *this / o; }

  friend const Dual& operator+(const Dual& a) { return a; }
  friend Dual operator-(const Dual& a) { return a * -1.0; }
  friend Dual operator+(const Dual& a, const Dual& b) {
    Dual r(T(a.v + b.v), Unset{});
    for (std::size_t i = 0; i < r.d.size(); ++i) r.d[i] = a.d[i] + b.d[i];
    for (std::size_t k = 0; k != r.h.size(); ++k) r.h[k] = a.h[k] + b.h[k];
    return r;
  }
  friend Dual operator-(const Dual& a, const Dual& b) {
    Dual r(T(a.v - b.v), Unset{});
    for (std::size_t i = 0; i < r.d.size(); ++i) r.d[i] = a.d[i] - b.d[i];
    for (std::size_t k = 0; k != r.h.size(); ++k) r.h[k] = a.h[k] - b.h[k];
    return r;
  }
  friend Dual operator*(const Dual& a, const Dual& b) {
    Dual r(T(a.v * b.v), Unset{});
    for (std::size_t i = 0, k = 0; i < N; ++i) {
      r.d[i] = a.v * b.d[i] + a.d[i] * b.v;
      if constexpr (Order == 2)
        for (std::size_t j = 0; j <= i; ++j, ++k)
          r.h[k] = (a.v * b.h[k] + a.h[k] * b.v) + (a.d[i] * b.d[j] + a.d[j] * b.d[i]);
    }
    return r;
  }
  friend Dual inverse(const Dual& a) {
    const T i = T(1.0) / a.v, i2 = i * i;
    return a.chain(i, -i2, T(2.0) * i2 * i);
  }
  friend Dual operator/(const Dual& a, const Dual& b) { return a * inverse(b); }
  friend Dual operator+(Dual a, double b) { return a += b; }
  friend Dual operator+(double b, Dual a) { return a += b; }
  friend Dual operator-(Dual a, double b) { return a -= b; }
  friend Dual operator-(double b, const Dual& a) { return -a + b; }
  friend Dual operator*(const Dual& a, double b) {
    const T factor(b);
    Dual r(T(a.v * factor), Unset{});
    for (std::size_t i = 0; i < r.d.size(); ++i) r.d[i] = a.d[i] * factor;
    for (std::size_t k = 0; k != r.h.size(); ++k) r.h[k] = a.h[k] * factor;
    return r;
  }
  friend Dual operator*(double b, const Dual& a) { return a * b; }
  friend Dual operator/(const Dual& a, double b) { return a * (1.0 / b); }
  friend Dual operator/(double b, const Dual& a) { return inverse(a) * b; }

  // Comparisons use the values alone.
  friend auto operator<=>(const Dual& a, const Dual& b) requires is_scalar { return a.v <=> b.v; }
  friend auto operator<=>(const Dual& a, double b) requires is_scalar { return a.v <=> b; }
  friend bool operator==(const Dual& a, const Dual& b) requires is_scalar { return a.v == b.v; }
  friend bool operator==(const Dual& a, double b) requires is_scalar { return a.v == b; }

  friend Dual sqrt(const Dual& a) {
    using std::sqrt;
    const T r = sqrt(a.v), i = T(0.5) / r;
    return a.chain(r, i, T(-0.5) * i / a.v);
  }
  friend Dual log(const Dual& a) {
    using std::log;
    const T i = T(1.0) / a.v;
    return a.chain(log(a.v), i, -(i * i));
  }
  friend Dual exp(const Dual& a) {
    using std::exp;
    const T e = exp(a.v);
    return a.chain(e, e, e);
  }

  // Bases may be negative if the exponent is an integer, and 0 if it is at least 2 (or 0 or 1).
  friend Dual pow(const Dual& a, double p) {
    using std::pow;
    const auto power = [&a](double q) { return T(pow(a.v, T(q))); };
    return a.chain(power(p), p == 0 ? T(0.0) : T(p) * power(p - 1),
                   Order == 1 || p == 0 || p == 1 ? T(0.0) : T(p * (p - 1)) * power(p - 2));
  }
  friend Dual pow(double a, const Dual& p) {
    using std::log;
    using std::pow;
    const T f = pow(T(a), p.v), l = a == 0 ? T(0.0) : T(log(T(a)));
    return p.chain(f, l * f, l * l * f);
  }
  // The base must be positive.
  friend Dual pow(const Dual& a, const Dual& p) {
    using std::log;
    using std::pow;
    const T f = pow(a.v, p.v), l = log(a.v), q = f / a.v, pq = p.v * q;
    return chain(a, p, {f, pq, l * f, (p.v - T(1.0)) * pq / a.v, q + l * pq, l * l * f});
  }

  // The angle of (x, y), in (-pi, pi].
  friend Dual atan2(const Dual& y, const Dual& x) {
    using std::atan2;
    const T i = T(1.0) / (x.v * x.v + y.v * y.v), c = x.v * i, s = y.v * i;
    const T mixed = s * s - c * c, same = T(2.0) * c * s;
    return chain(y, x, {atan2(y.v, x.v), c, -s, -same, mixed, same});
  }

  // sqrt(a a + b b) without overflow.
  friend Dual hypot(const Dual& a, const Dual& b) {
    using std::hypot;
    const T r = hypot(a.v, b.v), i = either(r > T(0.0), T(1.0) / r, T(0.0));
    const T c = a.v * i, s = b.v * i;
    return chain(a, b, {r, c, s, s * s * i, -(c * s * i), c * c * i});
  }
  friend Dual abs(const Dual& a) { return either(a.v < T(0.0), -a, a); }
  friend Dual fabs(const Dual& a) { return abs(a); }
  friend Dual min(const Dual& a, const Dual& b) { return either(b.v < a.v, b, a); }
  friend Dual max(const Dual& a, const Dual& b) { return either(a.v < b.v, b, a); }

  // Overloads with a double in place of one of two arguments.
  friend Dual atan2(const Dual& y, double x) { return atan2(y, Dual(x)); }
  friend Dual atan2(double y, const Dual& x) { return atan2(Dual(y), x); }
  friend Dual hypot(const Dual& a, double b) { return hypot(a, Dual(b)); }
  friend Dual hypot(double a, const Dual& b) { return hypot(Dual(a), b); }
  friend Dual min(const Dual& a, double b) { return min(a, Dual(b)); }
  friend Dual min(double a, const Dual& b) { return min(Dual(a), b); }
  friend Dual max(const Dual& a, double b) { return max(a, Dual(b)); }
  friend Dual max(double a, const Dual& b) { return max(Dual(a), b); }

 private:
  struct Unset {};
  Dual(const T& value, Unset) : v(value) {}  // derivatives are written next
  void clear() {
    d.fill(T(0.0));
    h.fill(T(0.0));
  }
  static const T& either(bool first, const T& a, const T& b) { return first ? a : b; }
  static const Dual& either(bool first, const Dual& a, const Dual& b) { return first ? a : b; }
  template <class Mask>
  static T either(const Mask& first, const T& a, const T& b) requires(!is_scalar) {
    return select(first, a, b);
  }
  template <class Mask>
  static Dual either(const Mask& first, const Dual& a, const Dual& b) requires(!is_scalar) {
    Dual r(select(first, a.v, b.v), Unset{});
    for (std::size_t i = 0; i < r.d.size(); ++i) r.d[i] = select(first, a.d[i], b.d[i]);
    for (std::size_t k = 0; k != r.h.size(); ++k) r.h[k] = select(first, a.h[k], b.h[k]);
    return r;
  }
};

template <class T, int N>
using Dual1 = Dual<T, N, 1>;
template <class T, int N>
using Dual2 = Dual<T, N, 2>;

// Returns the first number where the comparison holds, otherwise the second: a branch that works on
// several elements at a time.
inline double select(bool first, double a, double b) { return first ? a : b; }
template <int N, int Order>
Dual<double, N, Order> select(bool first, const Dual<double, N, Order>& a,
                              const Dual<double, N, Order>& b) {
  return first ? a : b;
}
template <int N, int Order>
Dual<double, N, Order> select(bool first, const Dual<double, N, Order>& a, double b) {
  return first ? a : Dual<double, N, Order>(b);
}
template <int N, int Order>
Dual<double, N, Order> select(bool first, double a, const Dual<double, N, Order>& b) {
  return first ? Dual<double, N, Order>(a) : b;
}

// The two variables of an isotropic density.
template <class T>
std::array<Dual2<T, 2>, 2> dual2_variables(const T& a, const T& b) {
  return {Dual2<T, 2>::variable(a, 0), Dual2<T, 2>::variable(b, 1)};
}

namespace detail {

// The derivative of asin, 1 / sqrt(1 - x^2), without the cancellation of 1 - x^2.
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
