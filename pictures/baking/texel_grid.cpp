#include "majorant/pictures/baking/texel_grid.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/mesh/exact_predicates.h"
#include "majorant/mesh/nearest_point.h"

namespace majorant {
namespace {

// The covered part of a texel above which the centroid is more than rounding. Corners are rounded
// to about 1e-13 of a texel, which gives the centroid an error of 1e-7.
constexpr double kCertainPart = 1e-6;

// A triangle cut by four half-planes, each of which adds at most one corner.
class ConvexPolygon {
 public:
  explicit ConvexPolygon(const std::array<Vector2, 3>& corner) : count_(3) {
    std::copy(corner.begin(), corner.end(), points_.begin());
  }

  // Keeps the part where sign * (p[axis] - bound) >= 0 [Sutherland and Hodgman, Reentrant Polygon
  // Clipping, 1974].
  void keep(Index axis, double bound, double sign) {
    std::array<Vector2, 8> kept;
    std::size_t count = 0;
    for (std::size_t k = 0; k < count_; ++k) {
      const Vector2 &p = points_[k], &q = points_[(k + 1) % count_];
      const double at_p = sign * (p[axis] - bound), at_q = sign * (q[axis] - bound);
      if (at_p >= 0) kept[count++] = p;
      if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0))
        kept[count++] = p + at_p / (at_p - at_q) * (q - p);
    }
    points_ = kept;
    count_ = count;
  }

  // Returns twice the signed area, and the centroid, which is 0 without area.
  std::pair<double, Vector2> doubled_area_and_centroid() const {
    double area = 0;
    Vector2 moment = Vector2::Zero();
    for (std::size_t k = 1; k + 1 < count_; ++k) {
      const Vector2 a = points_[k] - points_[0], b = points_[k + 1] - points_[0];
      area += cross(a, b);
      moment += cross(a, b) * (a + b) / 3;
    }
    return {area, area != 0 ? Vector2(points_[0] + moment / area) : Vector2(0, 0)};
  }

  // Returns the mean of the corners, which lies in the polygon; none if rounding leaves no corners.
  std::optional<Vector2> mean() const {
    Vector2 sum = Vector2::Zero();
    for (std::size_t k = 0; k < count_; ++k) sum += points_[k];
    if (count_ == 0) return std::nullopt;
    return Vector2(sum / static_cast<double>(count_));
  }

 private:
  std::array<Vector2, 8> points_;
  std::size_t count_;
};

}  // namespace

TexelGrid::TexelGrid(int width, int height) : width_(width), height_(height) {
  if (width < 1 || height < 1) throw InvalidArgument("TexelGrid: sizes are at least 1");
}

int TexelGrid::column(double u) const {
  return static_cast<int>(std::clamp(std::floor(u * width_), 0.0, width_ - 1.0));
}

int TexelGrid::row(double v) const {
  return static_cast<int>(std::clamp(std::floor((1 - v) * height_), 0.0, height_ - 1.0));
}

bool interiors_meet(const std::array<Vector2, 3>& corner, const Box2& box) {
  const int sense = orientation(corner[0], corner[1], corner[2]);
  if (sense == 0) return false;
  for (Index axis = 0; axis < 2; ++axis) {
    const auto [least, most] = std::minmax({corner[0][axis], corner[1][axis], corner[2][axis]});
    if (most <= box.low[axis] || least >= box.high[axis]) return false;
  }
  const std::array<Vector2, 4> of_box{box.low, Vector2(box.high.x(), box.low.y()), box.high,
                                      Vector2(box.low.x(), box.high.y())};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector2 &p = corner[k], &q = corner[(k + 1) % 3];
    if (std::all_of(of_box.begin(), of_box.end(),
                    [&](const Vector2& c) { return sense * orientation(p, q, c) <= 0; }))
      return false;
  }
  return true;
}

ClippedTriangle clipped(const std::array<Vector2, 3>& corner, const Box2& box) {
  ConvexPolygon polygon(corner);
  for (Index axis = 0; axis < 2; ++axis) {
    polygon.keep(axis, box.low[axis], 1);
    polygon.keep(axis, box.high[axis], -1);
  }
  const auto [doubled, centroid] = polygon.doubled_area_and_centroid();
  const Vector2 size = box.high - box.low;
  ClippedTriangle part;
  part.area = std::abs(doubled) / 2;
  const Vector2 at = part.area > kCertainPart * size.prod()
                         ? centroid
                         : polygon.mean().value_or(Vector2((box.low + box.high) / 2));
  const auto lifted = [](const Vector2& p) { return Vector3(p.x(), p.y(), 0); };
  part.centroid =
      nearest_of_triangle(lifted(corner[0]), lifted(corner[1]), lifted(corner[2]), lifted(at))
          .barycentric;
  return part;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
