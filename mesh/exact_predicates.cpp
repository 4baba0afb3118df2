#include "majorant/mesh/exact_predicates.h"

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "majorant/framework/exact_integers.h"

namespace majorant {
namespace {

bool apart(double p, double q, double r, double s) {
  return std::max(p, q) < std::min(r, s) || std::max(r, s) < std::min(p, q);
}

bool precedes(const Vector2& a, const Vector2& b) {
  return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y());
}

using Integer = boost::multiprecision::cpp_int;
// The error of the computed in_circle(), relative to the sum of magnitudes [She97].
constexpr double kTenRoundings = (10 + 96 * kUnitRoundoff<double>)*kUnitRoundoff<double>;

template <class T>
int sign_of(const T& value) {
  return (value > 0) - (value < 0);
}

// Returns whether a - b is not rounded.
bool is_exact_difference(double a, double b) {
  const double difference = a - b, subtracted = a - difference;
  return subtracted == b && difference + subtracted == a;
}

// A product and its rounding error; neither may have underflown.
struct Product {
  double rounded, error;
};
std::optional<Product> exact_product(double a, double b) {
  constexpr double kSmall = 0x1p-900, kLarge = 0x1p1000;
  const double rounded = a * b;
  if (a == 0 || b == 0) return Product{0, 0};
  if (!(std::abs(rounded) > kSmall) || !(std::abs(rounded) < kLarge)) return {};
  return Product{rounded, std::fma(a, b, -rounded)};
}

// Returns the orientation if differences of coordinates are exact, as for points on a grid or close
// to each other.
std::optional<int> orientation_of_exact_differences(const Vector2& a, const Vector2& b,
                                                    const Vector2& c) {
  if (!is_exact_difference(b.x(), a.x()) || !is_exact_difference(c.y(), a.y()) ||
      !is_exact_difference(b.y(), a.y()) || !is_exact_difference(c.x(), a.x()))
    return {};
  const auto left = exact_product(b.x() - a.x(), c.y() - a.y()),
             right = exact_product(b.y() - a.y(), c.x() - a.x());
  if (!left || !right) return {};
  if (left->rounded != right->rounded) return left->rounded > right->rounded ? 1 : -1;
  return sign_of(left->error - right->error);
}

int exact_orientation(const Vector2& a, const Vector2& b, const Vector2& c) {
  const auto x = to_integers<Integer>(std::array{a.x(), a.y(), b.x(), b.y(), c.x(), c.y()});
  const Integer left = (x[2] - x[0]) * (x[5] - x[1]), right = (x[3] - x[1]) * (x[4] - x[0]);
  return (left > right) - (left < right);
}

// Returns the sign of in_circle() from the corners of a triangle relative to d, x and y of each.
template <class T>
int sign_of_circle(const T& ax, const T& ay, const T& bx, const T& by, const T& cx, const T& cy) {
  return sign_of<T>((ax * ax + ay * ay) * (bx * cy - by * cx) +
                    (bx * bx + by * by) * (cx * ay - cy * ax) +
                    (cx * cx + cy * cy) * (ax * by - ay * bx));
}

__extension__ typedef __int128 Int128;

// Returns the sign if differences of coordinates are exact and are integers of at most 29 bits
// times a power of two, as for points on a grid.
std::optional<int> in_circle_of_small_integers(const Vector2& a, const Vector2& b, const Vector2& c,
                                               const Vector2& d) {
  constexpr int kDigits = 29;
  const std::array corners = {&a, &b, &c};
  std::array<double, 6> differences;
  double largest = 0;
  for (std::size_t k = 0; k < 6; ++k) {
    const double left = (*corners[k / 2])[static_cast<Eigen::Index>(k % 2)],
                 right = d[static_cast<Eigen::Index>(k % 2)];
    if (!is_exact_difference(left, right)) return {};
    differences[k] = left - right;
    largest = std::max(largest, std::abs(differences[k]));
  }
  if (largest == 0) return 0;
  std::array<Int128, 6> x;
  for (std::size_t k = 0; k < 6; ++k) {
    const double scaled = std::scalbn(differences[k], kDigits - 1 - std::ilogb(largest));
    const auto integer = static_cast<std::int64_t>(scaled);
    if (static_cast<double>(integer) != scaled) return {};
    x[k] = integer;
  }
  return sign_of_circle<Int128>(x[0], x[1], x[2], x[3], x[4], x[5]);
}

int exact_in_circle(const Vector2& a, const Vector2& b, const Vector2& c, const Vector2& d) {
  const auto x =
      to_integers<Integer>(std::array{a.x(), a.y(), b.x(), b.y(), c.x(), c.y(), d.x(), d.y()});
  return sign_of_circle<Integer>(x[0] - x[6], x[1] - x[7], x[2] - x[6], x[3] - x[7], x[4] - x[6],
                                 x[5] - x[7]);
}

}  // namespace

int orientation(const Vector2& a, const Vector2& b, const Vector2& c) {
  const double left = (b.x() - a.x()) * (c.y() - a.y()), right = (b.y() - a.y()) * (c.x() - a.x());
  const double area = left - right;
  if (std::abs(area) > orientation_error(left, right)) return area > 0 ? 1 : -1;
  if (const auto sign = orientation_of_exact_differences(a, b, c)) return *sign;
  return exact_orientation(a, b, c);
}

int in_circle(const Vector2& a, const Vector2& b, const Vector2& c, const Vector2& d) {
  const double ax = a.x() - d.x(), ay = a.y() - d.y(), bx = b.x() - d.x(), by = b.y() - d.y(),
               cx = c.x() - d.x(), cy = c.y() - d.y();
  const double bc = bx * cy, cb = by * cx, ca = cx * ay, ac = cy * ax, ab = ax * by, ba = ay * bx;
  const double aa = ax * ax + ay * ay, bb = bx * bx + by * by, cc = cx * cx + cy * cy;
  const double value = aa * (bc - cb) + bb * (ca - ac) + cc * (ab - ba);
  const double size = aa * (std::abs(bc) + std::abs(cb)) + bb * (std::abs(ca) + std::abs(ac)) +
                      cc * (std::abs(ab) + std::abs(ba));
  const double error =
      kTenRoundings * size + std::numeric_limits<double>::min() * (1 + aa + bb + cc);
  if (std::abs(value) > error) return sign_of(value);
  if (const auto sign = in_circle_of_small_integers(a, b, c, d)) return *sign;
  return exact_in_circle(a, b, c, d);
}

bool on_segment(const Vector2& a, const Vector2& b, const Vector2& p) {
  const auto within = [](double x, double s, double t) {
    return std::min(s, t) <= x && x <= std::max(s, t);
  };
  return within(p.x(), a.x(), b.x()) && within(p.y(), a.y(), b.y()) && orientation(a, b, p) == 0;
}

bool segments_meet(const Vector2& a, const Vector2& b, const Vector2& c, const Vector2& d) {
  // Segments on one line meet if their boxes do.
  return !apart(a.x(), b.x(), c.x(), d.x()) && !apart(a.y(), b.y(), c.y(), d.y()) &&
         orientation(a, b, c) * orientation(a, b, d) <= 0 &&
         orientation(c, d, a) * orientation(c, d, b) <= 0;
}

bool segments_fold(const Vector2& a, const Vector2& b, const Vector2& d) {
  return orientation(a, b, d) == 0 && precedes(a, b) != precedes(b, d);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
