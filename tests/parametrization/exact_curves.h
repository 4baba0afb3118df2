// Common points of planar curves in exact rational arithmetic, by elimination and Tarski queries:
// nothing in common with how curve_contact.cpp decides.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <vector>

#include "majorant/parametrization/curve_contact.h"

namespace majorant::exact {

using Rational = boost::multiprecision::cpp_rational;
using Polynomial = std::vector<Rational>;  // by power, no leading zeros; empty: zero

inline Polynomial trimmed(Polynomial p) {
  while (!p.empty() && p.back() == 0) p.pop_back();
  return p;
}

inline Polynomial operator+(Polynomial a, const Polynomial& b) {
  a.resize(std::max(a.size(), b.size()));
  for (std::size_t k = 0; k < b.size(); ++k) a[k] += b[k];
  return trimmed(std::move(a));
}

inline Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  if (a.empty() || b.empty()) return {};
  Polynomial p(a.size() + b.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) p[i + j] += a[i] * b[j];
  return trimmed(std::move(p));
}

inline Polynomial times(const Rational& c, const Polynomial& p) { return Polynomial{c} * p; }
inline Polynomial operator-(const Polynomial& a, const Polynomial& b) { return a + times(-1, b); }

inline Rational value(const Polynomial& p, const Rational& t) {
  Rational v = 0;
  for (std::size_t k = p.size(); k-- > 0;) v = v * t + p[k];
  return v;
}

inline Polynomial derivative(const Polynomial& p) {
  Polynomial d;
  for (std::size_t k = 1; k < p.size(); ++k) d.push_back(p[k] * static_cast<long>(k));
  return d;
}

inline Polynomial remainder(Polynomial a, const Polynomial& b) {
  while (a.size() >= b.size()) {
    const Rational q = a.back() / b.back();
    const std::size_t shift = a.size() - b.size();
    for (std::size_t k = 0; k < b.size(); ++k) a[shift + k] -= q * b[k];
    a.pop_back();
    a = trimmed(std::move(a));
  }
  return a;
}

// f / (t - root)^m with the largest m.
inline Polynomial without_root(Polynomial f, const Rational& root) {
  while (f.size() > 1 && value(f, root) == 0) {
    Polynomial q(f.size() - 1);
    Rational carry = 0;
    for (std::size_t k = f.size() - 1; k-- > 0;) q[k] = carry = f[k + 1] + root * carry;
    f = std::move(q);
  }
  return f;
}

// Sum of sign g over the distinct roots of f in (0, 1); f(0), f(1) != 0.
inline int tarski_query(const Polynomial& f, const Polynomial& g) {
  std::vector<Polynomial> sequence{f, derivative(f) * g};
  while (!sequence.back().empty())
    sequence.push_back(times(-1, remainder(sequence[sequence.size() - 2], sequence.back())));
  sequence.pop_back();
  const auto changes = [&](const Rational& t) {
    int count = 0, before = 0;
    for (const Polynomial& p : sequence) {
      const int sign = value(p, t).sign();
      if (sign != 0 && before != 0 && sign != before) ++count;
      if (sign != 0) before = sign;
    }
    return count;
  };
  return changes(0) - changes(1);
}

// Distinct roots of f in (0, 1) with g >= 0.
inline int roots_inside(const Polynomial& f, const Polynomial& g) {
  const int negative = (tarski_query(f, g * g) - tarski_query(f, g)) / 2;
  return tarski_query(f, {Rational(1)}) - negative;
}

// Coordinate c of a curve.
inline Polynomial coordinate(const PlanarCurve& curve, int c) {
  Polynomial sum;
  for (int k = 0; k <= curve.degree; ++k) {
    Polynomial term{Rational(curve.control_points[static_cast<std::size_t>(k)][c])};
    for (int i = 0; i < k; ++i) term = times(Rational(curve.degree - i) / (i + 1), term);
    for (int i = 0; i < curve.degree; ++i)
      term = term *
             (i < k ? Polynomial{Rational(0), Rational(1)} : Polynomial{Rational(1), Rational(-1)});
    sum = sum + term;
  }
  return sum;
}

// Points of b (parameters in [0, 1]) that lie on the quadratic or straight curve a, not counting
// b's start if it is a's end and `neighbours` is set. -1: not decided here (a is degenerate, or the
// curves lie on each other).
enum class Ends { All, WithoutCommon };
inline int common_points(const PlanarCurve& a, const PlanarCurve& b, Ends ends) {
  Polynomial u[2][3];  // coefficients, by power of s, of a(s) - b(t): polynomials in t
  for (int c = 0; c < 2; ++c) {
    Polynomial p = coordinate(a, c);
    p.resize(3);
    for (std::size_t k = 0; k < 3; ++k) u[c][k] = trimmed({p[k]});
    u[c][0] = u[c][0] - coordinate(b, c);
  }
  const auto minor = [&](int i, int j) { return u[0][i] * u[1][j] - u[0][j] * u[1][i]; };
  Polynomial f, s;  // f(t) = 0 where b(t) is on the whole curve, which has parameter s(t) there
  if (a.degree == 1) {
    f = minor(1, 0);
    const Rational length = value(u[0][1] * u[0][1] + u[1][1] * u[1][1], 0);
    if (length == 0) return -1;
    s = times(-1 / length, u[0][1] * u[0][0] + u[1][1] * u[1][0]);
  } else {
    const Polynomial d = minor(2, 1);
    if (d.empty()) return -1;
    f = minor(2, 0) * minor(2, 0) - d * minor(1, 0);
    s = times(-1 / d[0], minor(2, 0));
  }
  if (f.empty()) return -1;
  const Polynomial within = s * (Polynomial{Rational(1)} - s);
  int count = 0;
  for (const int end : {0, 1}) {
    const bool common = ends == Ends::WithoutCommon && end == 0;
    if (!common && value(f, end) == 0 && value(within, end) >= 0) ++count;
    f = without_root(f, end);
  }
  return count + roots_inside(f, within);
}

// Whether a cubic passes a point twice; -1 where the elimination degenerates.
inline int self_intersections(const PlanarCurve& cubic) {
  Rational v[2][4];
  for (int c = 0; c < 2; ++c) {
    Polynomial p = coordinate(cubic, c);
    p.resize(4);
    for (std::size_t k = 0; k < 4; ++k) v[c][k] = p[k];
  }
  const auto cross = [&](int i, int j) -> Rational {
    return v[0][i] * v[1][j] - v[1][i] * v[0][j];
  };
  if (cross(3, 2) == 0) return -1;
  // Sum and product of the two parameters.
  const Rational sum = -cross(3, 1) / cross(3, 2);
  const int c = v[0][3] != 0 ? 0 : 1;
  const Rational product = sum * sum + (v[c][2] * sum + v[c][1]) / v[c][3];
  const bool real = sum * sum - 4 * product > 0;
  return real && product >= 0 && 1 - sum + product >= 0 && sum > 0 && sum < 2 ? 1 : 0;
}

}  // namespace majorant::exact
