// Common points of planar curves in exact rational arithmetic, by elimination, Descartes' rule and
// Tarski queries, independent of curve_contact.cpp.
#pragma once

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <vector>

#include "majorant/certify/internal/curve_contact.h"

namespace majorant::exact {

using Rational = boost::multiprecision::cpp_rational;
using Polynomial = std::vector<Rational>;  // coefficients by power, no leading zeros; empty: zero

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

// Returns f / (t - root)^m with the largest m.
inline Polynomial without_root(Polynomial f, const Rational& root) {
  while (f.size() > 1 && value(f, root) == 0) {
    Polynomial q(f.size() - 1);
    Rational carry = 0;
    for (std::size_t k = f.size() - 1; k-- > 0;) q[k] = carry = f[k + 1] + root * carry;
    f = std::move(q);
  }
  return f;
}

// Returns the sum of sign g over the distinct roots of f in (0, 1); f(0), f(1) != 0.
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

// Bernstein coefficients over [0, 1], times a positive number that makes them integers.
using Integers = std::vector<boost::multiprecision::cpp_int>;
inline Integers bernstein(const Polynomial& p) {
  std::vector<Rational> b;
  for (std::size_t k = 0; k < p.size(); ++k) {
    Rational sum = 0, ratio = 1;  // C(k, i) / C(n, i)
    for (std::size_t i = 0; i <= k; ++i) {
      sum += ratio * p[i];
      if (i < k) ratio *= Rational(static_cast<long>(k - i)) / static_cast<long>(p.size() - 1 - i);
    }
    b.push_back(sum);
  }
  boost::multiprecision::cpp_int common = 1;
  for (const Rational& c : b) common = lcm(common, denominator(c));
  Integers scaled;
  for (const Rational& c : b) scaled.push_back(numerator(c) * (common / denominator(c)));
  return scaled;
}

// Returns both halves, times a power of two.
inline std::pair<Integers, Integers> halves(Integers row) {
  Integers left, right;
  const std::size_t degree = row.size() - 1;
  for (std::size_t level = 0; level <= degree; ++level) {
    left.push_back(row[0] << (degree - level));
    right.insert(right.begin(), row.back() << (degree - level));
    for (std::size_t k = 0; k + 1 < row.size(); ++k) row[k] += row[k + 1];
    row.pop_back();
  }
  return {left, right};
}

// Returns the number of distinct roots of f in the open interval with g >= 0, by Descartes' rule
// and bisection; -1 if the limit of steps is reached, for instance at multiple roots.
inline int isolate(const Integers& f, const Integers& g, int depth) {
  int changes = 0, before = 0;
  for (const auto& c : f) {
    changes += c.sign() * before < 0;
    if (c.sign() != 0) before = c.sign();
  }
  if (changes == 0) return 0;
  const auto everywhere = [&](int sign) {
    return std::all_of(g.begin(), g.end(), [&](const auto& c) { return c.sign() == sign; });
  };
  if (everywhere(-1)) return 0;
  if (changes == 1 && everywhere(1)) return 1;
  if (depth == 0) return -1;
  const auto [f_left, f_right] = halves(f);
  const auto [g_left, g_right] = halves(g);
  const int left = isolate(f_left, g_left, depth - 1);
  const int right = left < 0 ? -1 : isolate(f_right, g_right, depth - 1);
  if (right < 0) return -1;
  return left + right + (f_right[0] == 0 && g_right[0] >= 0);
}

// Returns the number of distinct roots of f in (0, 1) with g >= 0; -1: not decided (multiple roots
// of a large degree).
inline int roots_inside(const Polynomial& f, const Polynomial& g) {
  constexpr int kBisections = 100;
  constexpr std::size_t kLargeDegree = 7;
  if (f.size() < 2) return 0;
  const int count = g.empty() ? -1 : isolate(bernstein(f), bernstein(g), kBisections);
  if (count >= 0 || f.size() > kLargeDegree + 1) return count;
  const int negative = (tarski_query(f, g * g) - tarski_query(f, g)) / 2;
  return tarski_query(f, {Rational(1)}) - negative;
}

// Returns coordinate c of a curve.
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

// a(s) - b(t): coefficients, by power of s, of both coordinates, polynomials in t.
using Difference = std::array<std::vector<Polynomial>, 2>;
inline Difference difference(const PlanarCurve& a, const PlanarCurve& b) {
  Polynomial p[2] = {coordinate(a, 0), coordinate(a, 1)};
  const std::size_t size = std::max(p[0].size(), p[1].size());
  Difference u;
  for (std::size_t c = 0; c < 2; ++c) {
    p[c].resize(size);
    for (const Rational& coefficient : p[c]) u[c].push_back(trimmed({coefficient}));
    if (size > 0) u[c][0] = u[c][0] - coordinate(b, static_cast<int>(c));
  }
  return u;
}

// f(t) = 0 where b(t) is on the whole curve a, at a's parameter above / below. `below` is a
// constant for degree 2, otherwise not 0 at simple points. Empty f: degenerate.
struct Elimination {
  Polynomial f, above, below{Rational(1)};
};

inline Elimination eliminate_line(const Difference& u) {
  const Rational length = value(u[0][1] * u[0][1] + u[1][1] * u[1][1], 0);
  return {u[0][1] * u[1][0] - u[0][0] * u[1][1],
          times(-1 / length, u[0][1] * u[0][0] + u[1][1] * u[1][0])};
}

inline Elimination eliminate_parabola(const Difference& u) {
  const auto minor = [&](std::size_t i, std::size_t j) {
    return u[0][i] * u[1][j] - u[0][j] * u[1][i];
  };
  const Polynomial d = minor(2, 1);
  if (d.empty()) return {};
  return {minor(2, 0) * minor(2, 0) - d * minor(1, 0), times(-1 / d[0], minor(2, 0))};
}

inline Polynomial determinant(const std::vector<std::vector<Polynomial>>& m) {
  if (m.size() == 1) return m[0][0];
  Polynomial sum;
  for (std::size_t column = 0; column < m.size(); ++column) {
    std::vector<std::vector<Polynomial>> minor(m.begin() + 1, m.end());
    for (auto& row : minor) row.erase(row.begin() + static_cast<std::ptrdiff_t>(column));
    const Polynomial term = m[0][column] * determinant(minor);
    sum = column % 2 == 0 ? sum + term : sum - term;
  }
  return sum;
}

// By the Bezout matrix, which is singular at common points, with kernel (1, s, s^2, ...).
inline Elimination eliminate(const Difference& u) {
  const std::size_t n = u[0].size() - 1;
  std::vector<std::vector<Polynomial>> bezout(n, std::vector<Polynomial>(n));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t k = 0; k <= std::min(i, n - 1 - j); ++k)
        bezout[i][j] = bezout[i][j] + u[0][j + k + 1] * u[1][i - k] - u[1][j + k + 1] * u[0][i - k];
  const auto cofactor = [&](std::size_t column) {  // of the first row
    std::vector<std::vector<Polynomial>> minor(bezout.begin() + 1, bezout.end());
    for (auto& row : minor) row.erase(row.begin() + static_cast<std::ptrdiff_t>(column));
    return column % 2 == 0 ? determinant(minor) : times(-1, determinant(minor));
  };
  return {determinant(bezout), cofactor(1), cofactor(0)};
}

// Returns the number of points of b (parameters in [0, 1]) on a; with WithoutCommon, b's start is
// not counted if it is a's end. -1: not decided (a is degenerate, the curves coincide, or they
// touch at a high degree).
enum class Ends { All, WithoutCommon };
inline int common_points(const PlanarCurve& a, const PlanarCurve& b, Ends ends) {
  const Difference u = difference(a, b);
  if (u[0].size() < 2) return -1;
  const Elimination e = u[0].size() == 2   ? eliminate_line(u)
                        : u[0].size() == 3 ? eliminate_parabola(u)
                                           : eliminate(u);
  Polynomial f = e.f;
  if (f.empty()) return -1;
  const Polynomial within = e.above * (e.below - e.above);
  int count = 0;
  for (const int end : {0, 1}) {
    const bool common = ends == Ends::WithoutCommon && end == 0;
    if (!common && value(f, end) == 0 && value(within, end) >= 0) ++count;
    f = without_root(f, end);
  }
  const int inside = roots_inside(f, within);
  return inside < 0 ? -1 : count + inside;
}

// Returns 1 if a cubic intersects itself, 0 if not, and -1 if the elimination degenerates.
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

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
