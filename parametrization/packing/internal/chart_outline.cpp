#include "majorant/parametrization/packing/internal/chart_outline.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "majorant/certify/boundary_loops.h"
#include "majorant/maps/smallest_rectangle.h"

namespace majorant {
namespace {

// Returns half the integral of c x c' dt over the curves. For Bernstein coefficients it is a sum of
// c_i x (c_{j+1} - c_j) with the weights C(n,i) C(n-1,j) / (2 C(2n-1,i+j)).
double enclosed_area(const BoundaryLoops& boundary) {
  const auto binomial = [](int n, int k) {
    double value = 1;
    for (int i = 1; i <= k; ++i) value = value * (n - k + i) / i;
    return value;
  };
  double twice = 0;
  const Vector2 origin = boundary.curves.front().front();
  for (const PlanarCurve& curve : boundary.curves) {
    const int n = curve.degree;
    const auto& p = curve.control_points;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j < n; ++j)
        twice += binomial(n, i) * binomial(n - 1, j) / (2 * binomial(2 * n - 1, i + j)) *
                 cross(p[i] - origin, p[j + 1] - p[j]);
  }
  return twice / 2;
}

// Appends points of the curve, without its last one, such that the curve is within `reach` of their
// polygon. Returns the reach achieved. A piece is as close to its chord as its control points are.
double append_points(const std::vector<Vector2>& curve, double reach, int depth,
                     std::vector<Vector2>& points) {
  constexpr int kDepth = 12;  // 4096 pieces; each cut takes the distance to a quarter
  const Vector2 chord = curve.back() - curve.front();
  const double squared = chord.squaredNorm();
  double farthest = 0;
  for (std::size_t k = 1; k + 1 < curve.size(); ++k) {
    const Vector2 p = curve[k] - curve.front();
    const double t = squared > 0 ? std::clamp(p.dot(chord) / squared, 0.0, 1.0) : 0;
    farthest = std::max(farthest, (p - t * chord).norm());
  }
  if (farthest <= reach || depth == kDepth) {
    points.push_back(curve.front());
    return farthest;
  }
  std::vector<Vector2> left{curve.front()}, right = curve;
  for (std::size_t level = 1; level < curve.size(); ++level) {
    for (std::size_t k = 0; k + level < curve.size(); ++k) right[k] = (right[k] + right[k + 1]) / 2;
    left.push_back(right.front());
  }
  const double of_left = append_points(left, reach, depth + 1, points);
  return std::max(of_left, append_points(right, reach, depth + 1, points));
}

BoundaryLoops boundary_in_units(const BezierMap& chart, double unit) {
  BoundaryLoops boundary = boundary_loops(chart);
  for (PlanarCurve& curve : boundary.curves)
    for (int k = 0; k <= curve.degree; ++k) curve.control_points[k] /= unit;
  return boundary;
}

// A direction is lost if the mean of its image is shorter than this, relative to an isometry: half
// a degree.
constexpr double kAcross = 1e-2;

ChartOutline turned_outline(const BezierMap& chart, const BoundaryLoops& boundary, double unit,
                            double reach, const Vector2& turn) {
  const auto nodes = chart.control_points().reshaped(2, chart.space().node_count());
  ChartOutline out;
  out.cosine = turn.x();
  out.sine = turn.y();
  Eigen::Matrix2d R;
  R << out.cosine, -out.sine, out.sine, out.cosine;
  const Eigen::Matrix2Xd turned = R * nodes / unit;
  out.low = turned.rowwise().minCoeff();
  out.size = turned.rowwise().maxCoeff() - out.low;
  out.area = enclosed_area(boundary);
  for (const BoundaryLoop& loop : boundary.loops) {
    std::vector<Vector2>& points = out.outline.loops.emplace_back();
    for (Index k = loop.first; k < loop.last; ++k) {
      const PlanarCurve& curve = boundary.curves[k];
      std::vector<Vector2> moved;
      for (int i = 0; i <= curve.degree; ++i)
        moved.push_back(R * curve.control_points[i] - out.low);
      Outline& outline = out.outline;
      outline.reach = std::max(outline.reach, append_points(moved, reach, 0, points));
    }
  }
  return out;
}

// Edges run along a direction if their angle to it, or to its normal, is less than this, radians.
constexpr double kAlong = 0.01;
// If at least this fraction of a boundary's length runs along one direction, the chart is aligned
// with that direction.
constexpr double kStraight = 0.75;

bool is_along(const Vector2& a, const Vector2& b) {
  return std::min(std::abs(a.dot(b)), std::abs(cross(a, b))) <= 2 * kAlong;
}

// Returns the direction along which most of the boundary's chords run.
std::optional<Vector2> straight_direction(const BoundaryLoops& boundary) {
  constexpr double kQuarter = std::numbers::pi / 2;
  std::vector<std::pair<double, double>> edges;  // angle in 0..pi/2, length
  double whole = 0;
  for (const PlanarCurve& curve : boundary.curves) {
    const Vector2 along = curve.back() - curve.front();
    const double angle = std::atan2(along.y(), along.x()) + 2 * kQuarter;
    edges.emplace_back(angle - kQuarter * std::floor(angle / kQuarter), along.norm());
    whole += along.norm();
  }
  std::sort(edges.begin(), edges.end());
  const std::size_t count = edges.size();
  for (std::size_t k = 0; k < count; ++k)
    edges.emplace_back(edges[k].first + kQuarter, edges[k].second);
  double length = 0, turned = 0, most = 0, best = 0;  // turned: sum of length times angle
  for (std::size_t first = 0, last = 0; first < count; ++first) {
    for (; last < first + count && edges[last].first <= edges[first].first + 2 * kAlong; ++last) {
      length += edges[last].second;
      turned += edges[last].first * edges[last].second;
    }
    if (length > most) {
      most = length;
      best = turned / length;
    }
    length -= edges[first].second;
    turned -= edges[first].first * edges[first].second;
  }
  if (!(most >= kStraight * whole)) return std::nullopt;
  return Vector2(std::cos(best), std::sin(best));
}

SmallestRectangle rectangle_along(const std::vector<Vector2>& points, const Vector2& side) {
  Eigen::AlignedBox2d box;
  for (const Vector2& p : points) box.extend(Vector2(p.dot(side), cross(side, p)));
  SmallestRectangle out;
  out.side = side;
  out.along = box.sizes().x();
  out.across = box.sizes().y();
  return out;
}

}  // namespace

double chart_area(const BezierMap& chart, double unit) {
  return enclosed_area(boundary_in_units(chart, unit));
}

// The derivative of a linear map along a direction d, times the area of its triangle, is half the
// sum over corners of uv times (n x opposite edge) . d, where n is the unit normal.
std::optional<Vector2> upright_turn(const BezierMap& chart, const Vector3& up) {
  const SurfaceMesh& mesh = chart.mesh();
  const Vector3 d = up.stableNormalized();
  Vector2 mean = Vector2::Zero();
  double surface = 0, image = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto position = [&](int k) { return Vector3(mesh.positions().row(mesh.faces()(f, k))); };
    const auto uv = [&](int k) {
      return Vector2(chart.control_points().segment<2>(2 * chart.space().cells()(f, k)));
    };
    const Vector3 across = (position(1) - position(0)).cross(position(2) - position(0));
    const double twice = across.norm();
    if (!(twice > 0)) continue;
    surface += twice / 2;
    image += cross(Vector2(uv(1) - uv(0)), Vector2(uv(2) - uv(0))) / 2;
    for (int k = 0; k < 3; ++k) {
      const Vector3 opposite = position((k + 2) % 3) - position((k + 1) % 3);
      mean += uv(k) * (across.cross(opposite).dot(d) / twice / 2);
    }
  }
  const double length = mean.norm();
  if (!(length > kAcross * std::sqrt(surface * std::abs(image)))) return std::nullopt;
  return Vector2(mean.y(), mean.x()) / length;
}

ChartOutline chart_outline(const BezierMap& chart, double unit, double reach, Turn turn) {
  const BoundaryLoops boundary = boundary_in_units(chart, unit);
  Vector2 rotation(1, 0);
  if (turn == Turn::Tightest) {
    std::vector<Vector2> rim;
    for (const PlanarCurve& curve : boundary.curves)
      rim.insert(rim.end(), curve.control_points.begin(),
                 curve.control_points.begin() + curve.degree + 1);
    SmallestRectangle box = smallest_rectangle(rim);
    const std::optional<Vector2> straight = straight_direction(boundary);
    if (straight && !is_along(*straight, box.side)) box = rectangle_along(rim, *straight);
    rotation = box.along < box.across ? Vector2(-box.side.y(), -box.side.x())
                                      : Vector2(box.side.x(), -box.side.y());
  }
  return turned_outline(chart, boundary, unit, reach, rotation);
}

ChartOutline upright_outline(const BezierMap& chart, double unit, double reach,
                             const Vector2& turn) {
  ChartOutline out = turned_outline(chart, boundary_in_units(chart, unit), unit, reach, turn);
  out.quarter_turns = 1;
  return out;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
