#include "majorant/mesh/triangulate_polygon.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "majorant/mesh/exact_predicates.h"
#include "majorant/mesh/internal/large_polygon.h"

namespace majorant {
namespace {

// Clipping takes time quadratic in the corners: 0.1 s for this many.
constexpr std::size_t kMostClipped = 2048;
// Polygons of at most this many corners are clipped without a poll.
constexpr std::size_t kSmall = 64;

// Returns the corners projected along the polygon's area vector (Newell).
std::vector<Vector2> flatten(const std::vector<Vector3>& corners) {
  Vector3 normal = Vector3::Zero();
  for (std::size_t k = 0; k < corners.size(); ++k)
    normal += (corners[k] - corners[0]).cross(corners[(k + 1) % corners.size()] - corners[0]);
  const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(normal, Vector3::UnitZ());
  std::vector<Vector2> flat;
  for (const Vector3& c : corners) flat.push_back((turn * (c - corners[0])).head<2>());
  return flat;
}

double smallest_angle(const Vector2& a, const Vector2& b, const Vector2& c) {
  const auto angle = [](const Vector2& p, const Vector2& q, const Vector2& r) {
    const Vector2 u = q - p, v = r - p;
    return std::atan2(cross(u, v), u.dot(v));
  };
  return std::min({angle(a, b, c), angle(b, c, a), angle(c, a, b)});
}

bool contains(const Vector2& a, const Vector2& b, const Vector2& c, const Vector2& p) {
  // A corner closer to an edge counts as on it: relative to the squared longest edge, some thousand
  // roundings; not tuned.
  constexpr double kOnEdge = 1e-12;
  const double slack =
      -kOnEdge * std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return cross(b - a, p - a) >= slack && cross(c - b, p - b) >= slack &&
         cross(a - c, p - c) >= slack;
}

// Clips the best remaining ear, again and again. An ear is the triangle of three successive
// corners, identified by its first. Clipping an ear changes the two ears before it, and the number
// of corners that other ears contain.
class EarClipping {
 public:
  EarClipping(std::vector<Vector2> flat, const StopCheck& stop)
      : flat_(std::move(flat)), stop_(stop), ears_(flat_.size()) {
    for (std::size_t k = 0; k < flat_.size(); ++k) left_.push_back(static_cast<int>(k));
  }

  std::vector<std::array<int, 3>> triangles() {
    std::vector<std::array<int, 3>> triangles;
    for (std::size_t k = 0; k < left_.size() && left_.size() > 4; ++k) judge(k);
    while (left_.size() > 3) {
      stop_.poll();
      const std::size_t best = left_.size() == 4 ? best_of_quad() : best_ear();
      const int clipped = corner(best + 1);
      triangles.push_back({corner(best), clipped, corner(best + 2)});
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>((best + 1) % left_.size()));
      if (left_.size() > 4) forget(clipped, best);
    }
    triangles.push_back({left_[0], left_[1], left_[2]});
    return triangles;
  }

 private:
  struct Ear {
    double angle = 0;  // the smallest, negative at a reflex corner
    int inside = 0;    // other corners that it contains
    double quality() const { return inside == 0 ? angle : std::min(angle, 0.0) - inside; }
  };

  int corner(std::size_t k) const { return left_[k % left_.size()]; }
  const Vector2& point(std::size_t k) const { return flat_[corner(k)]; }
  Ear& ear(std::size_t k) { return ears_[corner(k)]; }

  void judge(std::size_t k) {
    stop_.poll();
    Ear& e = ear(k);
    e = {smallest_angle(point(k), point(k + 1), point(k + 2)), 0};
    for (std::size_t q = k + 3; q < k + left_.size(); ++q)
      e.inside += contains(point(k), point(k + 1), point(k + 2), point(q));
  }

  // Updates the ears after a corner was clipped; the two ears before it contained that corner.
  void forget(int clipped, std::size_t best) {
    const Vector2& gone = flat_[clipped];
    // `best` is past the end if the last corner was the first of the ear.
    const std::size_t at = best < left_.size() ? best : left_.size() - 1;
    for (std::size_t k = at + 1; k < at + left_.size() - 1; ++k)
      if (contains(point(k), point(k + 1), point(k + 2), gone)) --ear(k).inside;
    judge(at);
    judge(at + left_.size() - 1);
  }

  std::size_t best_ear() {
    std::size_t best = 0;
    double best_quality = -std::numbers::pi;
    for (std::size_t k = 0; k < left_.size(); ++k)
      if (const double quality = ear(k).quality(); quality > best_quality) {
        best_quality = quality;
        best = k;
      }
    return best;
  }

  // Chooses the diagonal of a quad by both of its triangles.
  std::size_t best_of_quad() {
    std::size_t best = 0;
    double best_quality = -std::numbers::pi;
    for (std::size_t k = 0; k < 4; ++k) {
      judge(k);
      const double quality =
          std::min(ear(k).quality(), smallest_angle(point(k + 2), point(k + 3), point(k)));
      if (!(quality > best_quality)) continue;
      best_quality = quality;
      best = k;
    }
    return best;
  }

  std::vector<Vector2> flat_;
  const StopCheck& stop_;
  std::vector<Ear> ears_;  // by their first corner
  std::vector<int> left_;  // corners
};

}  // namespace

std::vector<std::array<int, 3>> triangulate_polygon(const std::vector<Vector3>& corners,
                                                    const StopCheck& stop) {
  std::vector<Vector2> flat = flatten(corners);
  if (flat.size() > kMostClipped) return triangulate_large_polygon(flat, stop);
  const StopCheck never;
  return EarClipping(std::move(flat), corners.size() > kSmall ? stop : never).triangles();
}

bool is_unfolded_cut_from(std::size_t first, const std::vector<Vector3>& corners,
                          const std::vector<Vector2>& uv, PolygonUse use) {
  // The height over the longest side below which a triangle counts as having no area, or as turned
  // over. The limits differ by some roundings of floats, between written and read positions.
  constexpr double kFlat = 1e-6;
  const double flat = use == PolygonUse::Written ? kFlat / 2 : kFlat;
  const double back = use == PolygonUse::Written ? 2 * kFlat : kFlat;
  const std::size_t n = corners.size();
  Vector3 normal = Vector3::Zero();
  double area = 0;
  for (std::size_t k = 1; k + 1 < n; ++k) {
    normal += (corners[k] - corners[0]).cross(corners[k + 1] - corners[0]);
    area += cross(Vector2(uv[k] - uv[0]), Vector2(uv[k + 1] - uv[0]));
  }
  normal = normal.stableNormalized();
  const int side = area > 0 ? 1 : -1;
  bool is_right = true;
  for (std::size_t k = 1; k + 1 < n; ++k) {
    const std::size_t a = first, b = (first + k) % n, c = (first + k + 1) % n;
    const Vector3 ab = corners[b] - corners[a], ac = corners[c] - corners[a];
    const double longest = std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()});
    const double height = ab.cross(ac).dot(normal);  // times the longest side
    if (!(height >= -back * longest)) return true;
    if (height > flat * longest) is_right &= orientation(uv[a], uv[b], uv[c]) == side;
  }
  return is_right;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
