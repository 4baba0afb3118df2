#include "majorant/quads/exact_normals.h"

#include <Eigen/Geometry>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>

#include "majorant/framework/exact_integers.h"
#include "majorant/framework/rounding.h"

namespace majorant {
namespace {

// Uses (a x b) . (c x d) = (a . c) (b . d) - (a . d) (b . c).
int exact_sign(const std::array<PointPair, 4>& pairs) {
  using Integer = boost::multiprecision::cpp_int;
  std::array<double, 24> numbers{};
  for (std::size_t i = 0; i < 4; ++i)
    for (int c = 0; c < 3; ++c) {
      numbers[6 * i + static_cast<std::size_t>(c)] = pairs[i].from[c];
      numbers[6 * i + 3 + static_cast<std::size_t>(c)] = pairs[i].to[c];
    }
  const std::vector<Integer> scaled = to_integers<Integer>(numbers);
  const auto dot = [&](std::size_t i, std::size_t k) {
    Integer sum = 0;
    for (std::size_t c = 0; c < 3; ++c)
      sum +=
          (scaled[6 * i + 3 + c] - scaled[6 * i + c]) * (scaled[6 * k + 3 + c] - scaled[6 * k + c]);
    return sum;
  };
  const Integer left = dot(0, 2) * dot(1, 3), right = dot(0, 3) * dot(1, 2);
  return (left > right) - (left < right);
}

}  // namespace

int sign_of_normals(const PointPair& a, const PointPair& b, const PointPair& c,
                    const PointPair& d) {
  const Vector3 p = a.to - a.from, q = b.to - b.from, r = c.to - c.from, s = d.to - d.from;
  const double value = p.cross(q).dot(r.cross(s));
  // Each product of four differences has at most 4 + 2 + 3 + 3 roundings on its way into the sum.
  constexpr double kRounding = 16 * kUnitRoundoff<double>;
  const auto size = [](const Vector3& x, const Vector3& y) {
    const Vector3 u = x.cwiseAbs(), v = y.cwiseAbs();
    return Vector3(u.y() * v.z() + u.z() * v.y(), u.z() * v.x() + u.x() * v.z(),
                   u.x() * v.y() + u.y() * v.x());
  };
  // Underflow adds an error below the smallest normal number to each sum.
  const Vector3 first = size(p, q), second = size(r, s);
  const double error = kRounding * first.dot(second) +
                       std::numeric_limits<double>::min() * (1 + first.sum() + second.sum());
  if (std::isfinite(error) && std::abs(value) > error) return value > 0 ? 1 : -1;
  return exact_sign({a, b, c, d});
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
