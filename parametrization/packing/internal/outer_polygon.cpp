#include "majorant/parametrization/packing/internal/outer_polygon.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "majorant/mesh/exact_predicates.h"

namespace majorant {
namespace {

// The removal of a corner at place k: corner k is bridged, or corners k and k + 1 are replaced by
// `tip`, where the sides beyond them meet.
struct Shortcut {
  double area = 0;  // added
  std::optional<Vector2> tip = {};
};

class Reducer {
 public:
  explicit Reducer(std::vector<Vector2> points) : points_(std::move(points)) {}

  bool reduce() {
    std::vector<Shortcut> shortcuts(points_.size());
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const std::optional<Shortcut> found = shortcut(k);
      if (!found) continue;
      shortcuts[k] = *found;
      order.push_back(k);
    }
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return shortcuts[a].area < shortcuts[b].area;
    });
    for (const std::size_t k : order) {
      if (!is_free(k, shortcuts[k])) continue;
      const std::size_t next = (k + 1) % points_.size();
      if (shortcuts[k].tip) points_[next] = *shortcuts[k].tip;
      points_.erase(points_.begin() + static_cast<std::ptrdiff_t>(k));
      return true;
    }
    return false;
  }

  std::vector<Vector2>& points() { return points_; }

 private:
  const Vector2& point(std::size_t k) const { return points_[k % points_.size()]; }

  std::optional<Shortcut> shortcut(std::size_t k) const {
    const Vector2 &a = point(k + points_.size() - 1), &b = point(k), &c = point(k + 1),
                  &d = point(k + 2);
    const int turn = orientation(a, b, c);
    if (turn <= 0) return Shortcut{-cross(b - a, c - a) / 2};
    if (orientation(b, c, d) <= 0) return {};
    const double parallel = cross(b - a, c - d);
    if (!(parallel < 0)) return {};  // they meet on the other side, or not at all
    const double t = cross(c - b, c - d) / parallel;
    const Vector2 tip = b + t * (b - a);
    if (!(t > 0) || !tip.allFinite() || orientation(b, tip, c) <= 0) return {};
    return Shortcut{cross(tip - b, c - b) / 2, tip};
  }

  // Returns whether no other side meets the added area.
  bool is_free(std::size_t k, const Shortcut& cut) const {
    const std::size_t n = points_.size(), before = (k + n - 1) % n;
    const Vector2 &a = point(before), &b = point(k), &c = point(k + 1);
    for (std::size_t l = 0; l < n; ++l) {
      const Vector2 &p = point(l), &q = point(l + 1);
      if (cut.tip) {
        // Sides next to b and c are on the other side of the lines ab and cd, or on them.
        const bool at_b = l == before || l == k, at_c = l == k || l == (k + 1) % n;
        if (!at_b && segments_meet(b, *cut.tip, p, q)) return false;
        if (!at_c && segments_meet(c, *cut.tip, p, q)) return false;
      } else if (l != before && l != k && l != (k + 1) % n) {
        // The triangle a, c, b is clockwise and contains no other vertex.
        if (orientation(a, b, p) <= 0 && orientation(b, c, p) <= 0 && orientation(c, a, p) <= 0)
          return false;
      }
    }
    return true;
  }

  std::vector<Vector2> points_;
};

}  // namespace

std::vector<Vector2> outer_polygon(std::vector<Vector2> points, std::size_t corners) {
  Reducer reducer(std::move(points));
  while (reducer.points().size() > std::max<std::size_t>(corners, 3) && reducer.reduce()) continue;
  return std::move(reducer.points());
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
