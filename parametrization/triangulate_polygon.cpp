#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "majorant/parametrization/surface_mesh.h"

namespace majorant {
namespace {

double cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

// Corners projected along the polygon's area vector (Newell).
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
  // A corner on an edge counts, whatever rounding makes of it.
  const double slack =
      -1e-12 * std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return cross(b - a, p - a) >= slack && cross(c - b, p - b) >= slack &&
         cross(a - c, p - c) >= slack;
}

}  // namespace

std::vector<std::array<int, 3>> triangulate_polygon(const std::vector<Vector3>& corners) {
  const std::vector<Vector2> flat = flatten(corners);
  std::vector<int> left(corners.size());
  for (std::size_t k = 0; k < left.size(); ++k) left[k] = static_cast<int>(k);
  const auto point = [&](std::size_t k) {
    return flat[static_cast<std::size_t>(left[k % left.size()])];
  };
  std::vector<std::array<int, 3>> triangles;
  while (left.size() > 3) {
    std::size_t best = 0;
    double best_quality = -std::numbers::pi;
    for (std::size_t k = 0; k < left.size(); ++k) {
      const Vector2 a = point(k), b = point(k + 1), c = point(k + 2);
      double quality = smallest_angle(a, b, c);  // negative at a reflex corner
      for (std::size_t q = k + 3; q < k + left.size(); ++q)
        if (contains(a, b, c, point(q))) quality = std::min(quality, 0.0) - 1;
      // In a quad, both triangles count.
      if (left.size() == 4) quality = std::min(quality, smallest_angle(c, point(k + 3), a));
      if (quality > best_quality) {
        best_quality = quality;
        best = k;
      }
    }
    const auto corner = [&](std::size_t k) { return left[(best + k) % left.size()]; };
    triangles.push_back({corner(0), corner(1), corner(2)});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>((best + 1) % left.size()));
  }
  triangles.push_back({left[0], left[1], left[2]});
  return triangles;
}

}  // namespace majorant
