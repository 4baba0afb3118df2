#include "majorant/maps/smallest_rectangle.h"

#include <algorithm>
#include <cmath>

#include "majorant/framework/rounding.h"

namespace majorant {
namespace {

// The least relative decrease of area for which a box is rotated: far above the rounding of areas,
// far below a visible effect on the fill ratio.
constexpr double kMinAreaGain = 1e-6;

struct Extents {
  double along, across;
  double area() const { return along * across; }
};

// The rectangle around the hull along a unit vector d, by the four corners farthest in its
// directions.
class Calipers {
 public:
  explicit Calipers(const std::vector<Vector2>& hull) : hull_(hull) {}

  // Directions must be passed in the order in which the hull's edges rotate.
  Extents along(const Vector2& d) {
    const Vector2 n(-d.y(), d.x());
    const Vector2 directions[4] = {d, n, -d, -n};
    for (std::size_t k = 0; k < 4; ++k) {
      if (!started_ && k > 0) tip_[k] = tip_[k - 1];
      for (std::size_t steps = 0; steps < hull_.size(); ++steps) {
        const std::size_t next = (tip_[k] + 1) % hull_.size();
        if (directions[k].dot(hull_[next] - hull_[tip_[k]]) < 0) break;
        tip_[k] = next;
      }
    }
    started_ = true;
    return {d.dot(hull_[tip_[0]] - hull_[tip_[2]]), n.dot(hull_[tip_[1]] - hull_[tip_[3]])};
  }

 private:
  const std::vector<Vector2>& hull_;
  std::size_t tip_[4] = {0, 0, 0, 0};
  bool started_ = false;
};

}  // namespace

// Uses Andrew's monotone chain.
std::vector<Vector2> convex_hull(std::vector<Vector2> points) {
  std::sort(points.begin(), points.end(), [](const Vector2& p, const Vector2& q) {
    return p.x() < q.x() || (p.x() == q.x() && p.y() < q.y());
  });
  std::vector<Vector2> hull;
  const auto chain = [&](auto first, auto last) {
    const std::size_t base = hull.size();
    for (; first != last; ++first) {
      while (hull.size() >= base + 2 &&
             cross(hull.back() - hull[hull.size() - 2], *first - hull.back()) <= 0)
        hull.pop_back();
      hull.push_back(*first);
    }
    hull.pop_back();
  };
  chain(points.begin(), points.end());
  chain(points.rbegin(), points.rend());
  return hull;
}

SmallestRectangle smallest_rectangle(const std::vector<Vector2>& points) {
  const std::vector<Vector2> hull = convex_hull(points);
  const auto [left, right] = std::minmax_element(
      points.begin(), points.end(), [](const auto& p, const auto& q) { return p.x() < q.x(); });
  const auto [bottom, top] = std::minmax_element(
      points.begin(), points.end(), [](const auto& p, const auto& q) { return p.y() < q.y(); });
  Extents best{right->x() - left->x(), top->y() - bottom->y()};
  Vector2 side = Vector2::UnitX();
  if (hull.size() >= 3) {
    Calipers calipers(hull);
    double least = best.area() * (1 - kMinAreaGain);
    for (std::size_t k = 0; k < hull.size(); ++k) {
      const Vector2 d = (hull[(k + 1) % hull.size()] - hull[k]).normalized();
      const Extents extents = calipers.along(d);
      if (!(extents.area() < least)) continue;
      least = extents.area();
      best = extents;
      side = d;
    }
  }
  return {side, best.along, best.across};
}

Vector2 layout_direction(const Points2& uv, const Cells& cells) {
  if (cells.size() == 0) return {1, 0};
  Vector2 low = uv.row(cells(0, 0)), high = low;
  for (const Index p : cells.reshaped()) {
    low = low.cwiseMin(uv.row(p).transpose());
    high = high.cwiseMax(uv.row(p).transpose());
  }
  // Halves are subtracted, since the difference of two finite numbers may overflow. A power of two
  // needs no rounding.
  const double size = (0.5 * high - 0.5 * low).maxCoeff();
  if (!(size > 0) || !std::isfinite(size)) return {1, 0};
  const double unit = power_of_two(size);
  std::vector<char> is_used(to_size(static_cast<Index>(uv.rows())), 0);
  for (const Index p : cells.reshaped()) is_used[p] = 1;
  std::vector<Vector2> points;
  for (Index p = 0; p < uv.rows(); ++p)
    if (is_used[p])
      points.emplace_back((uv(p, 0) - low.x() / 2 - high.x() / 2) / unit,
                          (uv(p, 1) - low.y() / 2 - high.y() / 2) / unit);
  const SmallestRectangle box = smallest_rectangle(points);
  Vector2 direction = box.side;
  if (box.across > box.along * (1 + kMinAreaGain)) direction = Vector2(-box.side.y(), box.side.x());
  const bool is_backwards = direction.x() < 0 || (direction.x() == 0 && direction.y() < 0);
  return is_backwards ? Vector2(-direction) : direction;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
