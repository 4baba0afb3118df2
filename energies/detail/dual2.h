// Second-order forward differentiation in N variables: a value, its gradient and its Hessian.
//
//   auto [S, s] = dual2_variables<double>(1.5, 0.7);
//   auto h = S * S + s * s + 1.0 / (S * S) + 1.0 / (s * s);   // h.v, h.d[i], h.hess(i, j)
//
// T is double or a SIMD batch. Small N only (2 for isotropic densities, 4 for general planar ones);
// everything is unrolled, nothing allocates.
#pragma once

#include <array>
#include <cmath>
#include <type_traits>

namespace majorant {

template <class T, int N>
struct Dual2 {
  T v{};
  std::array<T, N> d{};
  std::array<T, N*(N + 1) / 2> h{};  // lower triangle, row by row

  Dual2() = default;
  Dual2(double value) : v(value) { clear(); }
  explicit Dual2(const T& value) requires(!std::is_same_v<T, double>) : v(value) { clear(); }
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
    Dual2 r{f};
    for (std::size_t i = 0, k = 0; i < N; ++i) {
      r.d[i] = f1 * d[i];
      for (std::size_t j = 0; j <= i; ++j, ++k) r.h[k] = f1 * h[k] + f2 * (d[i] * d[j]);
    }
    return r;
  }

  Dual2& operator+=(const Dual2& o) {
    v += o.v;
    for (std::size_t i = 0; i < d.size(); ++i) d[i] += o.d[i];
    for (std::size_t k = 0; k < h.size(); ++k) h[k] += o.h[k];
    return *this;
  }
  Dual2& operator*=(double c) {
    const T factor(c);
    v *= factor;
    for (auto& x : d) x *= factor;
    for (auto& x : h) x *= factor;
    return *this;
  }
  friend Dual2 operator-(Dual2 a) { return a *= -1.0; }
  friend Dual2 operator+(Dual2 a, const Dual2& b) { return a += b; }
  friend Dual2 operator-(const Dual2& a, const Dual2& b) { return a + -b; }
  friend Dual2 operator*(const Dual2& a, const Dual2& b) {
    Dual2 r{T(a.v * b.v)};
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
  friend Dual2 operator+(Dual2 a, double b) {
    a.v += T(b);
    return a;
  }
  friend Dual2 operator+(double b, Dual2 a) {
    a.v += T(b);
    return a;
  }
  friend Dual2 operator-(Dual2 a, double b) {
    a.v -= T(b);
    return a;
  }
  friend Dual2 operator-(double b, const Dual2& a) { return -a + b; }
  friend Dual2 operator*(Dual2 a, double b) { return a *= b; }
  friend Dual2 operator*(double b, Dual2 a) { return a *= b; }
  friend Dual2 operator/(Dual2 a, double b) { return a *= 1.0 / b; }
  friend Dual2 operator/(double b, const Dual2& a) { return inverse(a) * b; }

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

 private:
  void clear() {
    d.fill(T(0.0));
    h.fill(T(0.0));
  }
};

// The two variables of an isotropic density.
template <class T>
std::array<Dual2<T, 2>, 2> dual2_variables(const T& a, const T& b) {
  return {Dual2<T, 2>::variable(a, 0), Dual2<T, 2>::variable(b, 1)};
}

}  // namespace majorant
