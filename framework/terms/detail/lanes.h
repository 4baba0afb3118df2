// One number for each of a few elements. Arithmetic and functions are those of doubles, lane by
// lane; comparisons give a mask, for select().
//
// Lanes are an array and not a vector register, so that their type is the same in files compiled
// for different instruction sets. Not for inclusion: local_term.h.
#pragma once

#include <cmath>

namespace majorant::detail {

// The number of doubles in the widest vector.
inline constexpr int kLanes = 8;

struct LaneMask {
  bool lane[kLanes];
};

class alignas(sizeof(double) * kLanes) Lanes {
 public:
  Lanes() = default;
  Lanes(double all) {
    for (double& x : lane_) x = all;
  }
  double operator[](int i) const { return lane_[i]; }
  double& operator[](int i) { return lane_[i]; }
  [[gnu::always_inline]] const double* data() const { return lane_; }
  [[gnu::always_inline]] double* data() { return lane_; }

  Lanes& operator+=(const Lanes& b) {
    return *this = with(*this, b, [](Vector& x, const Vector& y) { x += y; });
  }
  Lanes& operator-=(const Lanes& b) {
    return *this = with(*this, b, [](Vector& x, const Vector& y) { x -= y; });
  }
  Lanes& operator*=(const Lanes& b) {
    return *this = with(*this, b, [](Vector& x, const Vector& y) { x *= y; });
  }
  Lanes& operator/=(const Lanes& b) {
    return *this = with(*this, b, [](Vector& x, const Vector& y) { x /= y; });
  }
  friend Lanes operator+(const Lanes& a, const Lanes& b) {
    Lanes r = a;
    return r += b;
  }
  friend Lanes operator-(const Lanes& a, const Lanes& b) {
    Lanes r = a;
    return r -= b;
  }
  friend Lanes operator*(const Lanes& a, const Lanes& b) {
    Lanes r = a;
    return r *= b;
  }
  friend Lanes operator/(const Lanes& a, const Lanes& b) {
    Lanes r = a;
    return r /= b;
  }
  friend const Lanes& operator+(const Lanes& a) { return a; }
  friend Lanes operator-(const Lanes& a) {
    Lanes r;
    for (int i = 0; i < kLanes; ++i) r[i] = -a[i];
    return r;
  }

  friend LaneMask operator<(const Lanes& a, const Lanes& b) {
    return compare(a, b, [](double x, double y) { return x < y; });
  }
  friend LaneMask operator<=(const Lanes& a, const Lanes& b) {
    return compare(a, b, [](double x, double y) { return x <= y; });
  }
  friend LaneMask operator==(const Lanes& a, const Lanes& b) {
    return compare(a, b, [](double x, double y) { return x == y; });
  }
  friend LaneMask operator>(const Lanes& a, const Lanes& b) { return b < a; }
  friend LaneMask operator>=(const Lanes& a, const Lanes& b) { return b <= a; }
  friend Lanes select(const LaneMask& first, const Lanes& a, const Lanes& b) {
    Lanes r;
    for (int i = 0; i < kLanes; ++i) r[i] = first.lane[i] ? a[i] : b[i];
    return r;
  }

  // Applies a function of the standard library, lane by lane.
  template <class F>
  friend Lanes apply(const F& f, const Lanes& a) {
    Lanes r;
    for (int i = 0; i < kLanes; ++i) r[i] = f(a[i]);
    return r;
  }
  template <class F>
  friend Lanes apply(const F& f, const Lanes& a, const Lanes& b) {
    Lanes r;
    for (int i = 0; i < kLanes; ++i) r[i] = f(a[i], b[i]);
    return r;
  }

 private:
  typedef double Vector __attribute__((vector_size(sizeof(double) * kLanes)));
  template <class Operation>
  [[gnu::always_inline]] static Lanes with(const Lanes& a, const Lanes& b,
                                           const Operation& operation) {
    Vector x, y;
    __builtin_memcpy(&x, a.lane_, sizeof x);
    __builtin_memcpy(&y, b.lane_, sizeof y);
    operation(x, y);
    Lanes r;
    __builtin_memcpy(r.lane_, &x, sizeof x);
    return r;
  }
  template <class Comparison>
  static LaneMask compare(const Lanes& a, const Lanes& b, const Comparison& comparison) {
    LaneMask mask;
    for (int i = 0; i < kLanes; ++i) mask.lane[i] = comparison(a[i], b[i]);
    return mask;
  }

  double lane_[kLanes];
};

inline Lanes sqrt(const Lanes& a) {
  return apply([](double x) { return std::sqrt(x); }, a);
}
inline Lanes log(const Lanes& a) {
  return apply([](double x) { return std::log(x); }, a);
}
inline Lanes exp(const Lanes& a) {
  return apply([](double x) { return std::exp(x); }, a);
}
inline Lanes sin(const Lanes& a) {
  return apply([](double x) { return std::sin(x); }, a);
}
inline Lanes cos(const Lanes& a) {
  return apply([](double x) { return std::cos(x); }, a);
}
inline Lanes tan(const Lanes& a) {
  return apply([](double x) { return std::tan(x); }, a);
}
inline Lanes asin(const Lanes& a) {
  return apply([](double x) { return std::asin(x); }, a);
}
inline Lanes acos(const Lanes& a) {
  return apply([](double x) { return std::acos(x); }, a);
}
inline Lanes atan(const Lanes& a) {
  return apply([](double x) { return std::atan(x); }, a);
}
inline Lanes sinh(const Lanes& a) {
  return apply([](double x) { return std::sinh(x); }, a);
}
inline Lanes cosh(const Lanes& a) {
  return apply([](double x) { return std::cosh(x); }, a);
}
inline Lanes tanh(const Lanes& a) {
  return apply([](double x) { return std::tanh(x); }, a);
}
inline Lanes pow(const Lanes& a, const Lanes& b) {
  return apply([](double x, double y) { return std::pow(x, y); }, a, b);
}
inline Lanes atan2(const Lanes& a, const Lanes& b) {
  return apply([](double x, double y) { return std::atan2(x, y); }, a, b);
}
inline Lanes hypot(const Lanes& a, const Lanes& b) {
  return apply([](double x, double y) { return std::hypot(x, y); }, a, b);
}

}  // namespace majorant::detail

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
