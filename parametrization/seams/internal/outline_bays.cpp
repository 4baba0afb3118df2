#include "majorant/parametrization/seams/internal/outline_bays.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "majorant/mesh/geometry.h"

namespace majorant {
namespace {

// Upper bound on bays.
constexpr std::size_t kMaxBays = 8;
// The least depth of a bay, in square roots of the area that the outline encloses.
constexpr double kBayDepth = 0.06;

Vector2 place_in(const Vec& uv, Index vertex) { return uv.segment<2>(2 * vertex); }

// Returns indices into the outline of the corners of a polygon that stays within the tolerance of
// it [DP73]. The polygon begins at two places that are far from each other.
std::vector<Index> outline_corners(const Vec& uv, const std::vector<Index>& outline,
                                   double tolerance) {
  const auto n = static_cast<Index>(outline.size());
  const auto at = [&](Index i) { return place_in(uv, outline[to_size(i % n)]); };
  const auto farthest_from = [&](Index i) {
    Index most = i;
    for (Index k = 0; k < n; ++k)
      if ((at(k) - at(i)).squaredNorm() > (at(most) - at(i)).squaredNorm()) most = k;
    return most;
  };
  const Index first = farthest_from(0), second = farthest_from(first);
  std::vector<Index> corners;
  std::vector<std::pair<Index, Index>> runs{{second, first + (first < second ? n : 0)},
                                            {first, second + (second < first ? n : 0)}};
  while (!runs.empty()) {
    const auto [from, to] = runs.back();
    runs.pop_back();
    const Vector2 chord = at(to) - at(from);
    const double squared = chord.squaredNorm();
    Index most = -1;
    double far = tolerance;
    for (Index k = from + 1; k < to; ++k) {
      const Vector2 p = at(k) - at(from);
      const double t = squared > 0 ? std::clamp(p.dot(chord) / squared, 0.0, 1.0) : 0;
      if (const double d = (p - t * chord).norm(); d > far) far = d, most = k;
    }
    if (most < 0) {
      corners.push_back(from % n);
      continue;
    }
    runs.emplace_back(most, to);
    runs.emplace_back(from, most);
  }
  return corners;
}

}  // namespace

double enclosed_area(const Vec& uv, const std::vector<Index>& loop) {
  double twice = 0;
  const Vector2 origin = place_in(uv, loop.front());
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vector2 a = place_in(uv, loop[i]) - origin,
                  b = place_in(uv, loop[(i + 1) % loop.size()]) - origin;
    twice += cross(a, b);
  }
  return twice / 2;
}

std::vector<Index> bay_bottoms(const Vec& uv, const std::vector<Index>& outline) {
  const double depth_bound = kBayDepth * std::sqrt(enclosed_area(uv, outline));
  const std::vector<Index> corners = outline_corners(uv, outline, depth_bound);
  std::vector<std::pair<double, Index>> bays;  // minus the depth, the vertex
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const auto at = [&](std::size_t i) {
      return place_in(uv, outline[to_size(corners[i % corners.size()])]);
    };
    const Vector2 in = at(k) - at(k + corners.size() - 1), out = at(k + 1) - at(k);
    const double depth = -cross(in, out) / std::max(in.norm(), out.norm());
    if (depth > depth_bound) bays.emplace_back(-depth, outline[to_size(corners[k])]);
  }
  std::sort(bays.begin(), bays.end());
  if (bays.size() > kMaxBays) bays.resize(kMaxBays);
  std::vector<Index> bottoms;
  for (const auto& [unused, v] : bays) bottoms.push_back(v);
  return bottoms;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
