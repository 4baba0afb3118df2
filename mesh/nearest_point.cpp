#include "majorant/mesh/nearest_point.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"

namespace majorant {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
// The number of points of a task: successive points are often neighbours.
constexpr Index kPointsOfTask = 256;

std::vector<Box3> checked_boxes(const Points3& positions, const Cells& faces) {
  if (faces.rows() == 0) throw InvalidArgument("SurfaceTree: no faces");
  if (!positions.allFinite()) throw InvalidArgument("SurfaceTree: a position is not finite");
  return boxes_of_faces(positions, faces);
}

std::vector<Box3> boxes_of_points(const Points3& points) {
  std::vector<Box3> boxes;
  boxes.reserve(static_cast<std::size_t>(points.rows()));
  for (Index v = 0; v < points.rows(); ++v) boxes.push_back({points.row(v), points.row(v)});
  return boxes;
}

// Calls offer(barycentric, square) for points of the triangle that include its nearest point.
template <class Offer>
void offer_points(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& p,
                  const Offer& offer) {
  const std::array<Vector3, 3> corner{a, b, c};
  const auto offer_point = [&](const Barycentric& xi) {
    offer(xi, (a * xi[0] + b * xi[1] + c * xi[2] - p).squaredNorm());
  };
  const Vector3 ab = b - a, bc = c - b, ca = a - c;
  const std::array<Vector3, 3> edge{ab, bc, ca};
  const Vector3 normal = ab.cross(Vector3(c - a));
  const Vector3 to_a = a - p, to_b = b - p, to_c = c - p;
  const Barycentric inside(normal.dot(to_b.cross(to_c)), normal.dot(to_c.cross(to_a)),
                           normal.dot(to_a.cross(to_b)));
  const Vector3 squared(ab.squaredNorm(), bc.squaredNorm(), ca.squaredNorm());
  // In slivers the signs may be rounding alone, so every edge is offered. In other triangles the
  // nearest point is inside, or on an edge that p lies beyond.
  constexpr double kSliver = 1e-12;
  const double longest = squared.maxCoeff();
  const bool is_sliver = !(normal.squaredNorm() > kSliver * longest * longest);
  const bool is_inside = inside.minCoeff() > 0;
  if (is_inside) offer_point(inside / inside.sum());
  if (is_inside && !is_sliver) return;
  for (Index k = 0; k < 3; ++k) {
    if (!is_sliver && inside[(k + 2) % 3] > 0) continue;
    const Vector3& q = corner[to_size(k)];
    const double t =
        squared[k] > 0 ? std::clamp((p - q).dot(edge[to_size(k)]) / squared[k], 0.0, 1.0) : 0.0;
    Barycentric xi = Barycentric::Zero();
    xi[k] = 1 - t;
    xi[(k + 1) % 3] = t;
    offer_point(xi);
  }
}

}  // namespace

struct SurfaceTree::Candidate {
  Index face = -1;
  double square = kUnbounded;  // of the distance
  Barycentric barycentric = Barycentric::Zero();

  bool is_nearer_than(const Candidate& other) const {
    return square < other.square || (square == other.square && face < other.face);
  }
  NearestPoint point() const { return {face, barycentric, std::sqrt(square)}; }
};

NearestPoint nearest_of_triangle(const Vector3& a, const Vector3& b, const Vector3& c,
                                 const Vector3& p) {
  NearestPoint best;
  double least = kUnbounded;
  offer_points(a, b, c, p, [&](const Barycentric& xi, double square) {
    if (!(square < least)) return;
    least = square;
    best.barycentric = xi;
  });
  best.distance = std::sqrt(least);
  return best;
}

SurfaceTree::SurfaceTree(Points3 positions, Cells faces)
    : positions_(std::move(positions)),
      faces_(std::move(faces)),
      tree_(checked_boxes(positions_, faces_)) {}

SurfaceTree::Candidate SurfaceTree::of_face(Index face, const Vector3& p) const {
  Candidate best;
  best.face = face;
  offer_points(corner(face, 0), corner(face, 1), corner(face, 2), p,
               [&](const Barycentric& xi, double square) {
                 if (!(square < best.square)) return;
                 best.square = square;
                 best.barycentric = xi;
               });
  return best;
}

// Returns the nearest point, or any point whose squared distance is at most `enough`.
SurfaceTree::Candidate SurfaceTree::find(const Vector3& p, Index likely, double enough) const {
  const Index first = likely < 0 ? 0 : likely;
  Candidate best = of_face(first, p);
  double bound = best.square <= enough ? -1 : best.square;
  tree_.visit_near(p, bound, [&](Index face) {
    if (face == first || bound < 0) return;
    const Candidate other = of_face(face, p);
    if (other.is_nearer_than(best)) best = other;
    bound = best.square <= enough ? -1 : best.square;
  });
  return best;
}

NearestPoint SurfaceTree::nearest(const Vector3& p, Index likely) const {
  return find(p, likely, -1).point();
}

Vector3 SurfaceTree::doubled_normal(Index face) const {
  return (corner(face, 1) - corner(face, 0)).cross(corner(face, 2) - corner(face, 0));
}

NearestPoint SurfaceTree::nearest_facing(const Vector3& p, const Vector3& direction,
                                         double farthest, Index likely) const {
  Candidate best;
  double bound = farthest * farthest;
  const auto offer = [&](Index face) {
    if (!(doubled_normal(face).dot(direction) > 0)) return;
    const Candidate other = of_face(face, p);
    if (std::sqrt(other.square) <= farthest && other.is_nearer_than(best)) {
      best = other;
      bound = best.square;
    }
  };
  if (likely >= 0) offer(likely);
  tree_.visit_near(p, bound, offer);
  if (best.face >= 0) return best.point();
  NearestPoint none;
  none.distance = farthest;
  return none;
}

NearestPoint SurfaceTree::along(const Vector3& p, const Vector3& direction, double farthest) const {
  NearestPoint best;
  best.distance = farthest;
  double bound = farthest * farthest;
  // A box that the line meets within `best` is itself within `best`. The search visits further
  // boxes, which only cost tests of their faces, since `farthest` is small.
  tree_.visit_near(p, bound, [&](Index face) {
    const Vector3 normal = doubled_normal(face);
    const double slope = normal.dot(direction);
    if (!(slope > 0)) return;
    const std::array<Vector3, 3> to = {corner(face, 0) - p, corner(face, 1) - p,
                                       corner(face, 2) - p};
    const double t = std::abs(normal.dot(to[0]) / slope);
    if (!(t < best.distance || (t == best.distance && (best.face < 0 || face < best.face)))) return;
    const Barycentric xi(direction.dot(to[1].cross(to[2])) / slope,
                         direction.dot(to[2].cross(to[0])) / slope,
                         direction.dot(to[0].cross(to[1])) / slope);
    if (!(xi.minCoeff() >= 0)) return;
    best = {face, xi / xi.sum(), t};
    bound = t * t;
  });
  return best;
}

std::vector<Index> SurfaceTree::faces_within(const Vector3& p, double distance) const {
  std::vector<Index> found;
  const double square = distance * distance;
  tree_.visit_near(p, square, [&](Index face) {
    if (std::sqrt(of_face(face, p).square) <= distance) found.push_back(face);
  });
  std::sort(found.begin(), found.end());
  return found;
}

NearestFaces SurfaceTree::nearest_faces(const Vector3& p, double slack, Index likely) const {
  std::vector<Candidate> near;
  double least = kUnbounded, bound = kUnbounded;
  const auto offer = [&](Index face) {
    near.push_back(of_face(face, p));
    const double distance = std::sqrt(near.back().square);
    if (!(distance < least)) return;
    least = distance;
    bound = (least + slack) * (least + slack);
  };
  // The tree offers the same face again.
  if (likely >= 0) offer(likely);
  near.clear();
  tree_.visit_near(p, bound, offer);
  NearestFaces found{least, {}};
  for (const Candidate& one : near)
    if (std::sqrt(one.square) <= least + slack) found.faces.push_back(one.face);
  // Far from the origin rounding may place all boxes beyond the likely face; and no face is near a
  // point that is not finite.
  if (found.faces.empty()) found.faces.push_back(std::max(likely, 0));
  std::sort(found.faces.begin(), found.faces.end());
  return found;
}

std::vector<NearestPoint> SurfaceTree::locate(const Points3& p, const StopCheck& stop) const {
  const auto count = static_cast<Index>(p.rows());
  std::vector<NearestPoint> result(to_size(count));
  std::atomic<std::size_t> done = 0;
  parallel_tasks((count + kPointsOfTask - 1) / kPointsOfTask, [&](Index task, int) {
    stop.poll();
    Index likely = -1;
    const Index last = std::min(count, (task + 1) * kPointsOfTask);
    for (Index k = task * kPointsOfTask; k < last; ++k) {
      result[to_size(k)] = nearest(Vector3(p.row(k)), likely);
      likely = result[to_size(k)].face;
    }
    stop.advance(done += to_size(kPointsOfTask), to_size(count));
  });
  return result;
}

double SurfaceTree::largest_distance(const Points3& p, double known, const StopCheck& stop) const {
  const auto count = static_cast<Index>(p.rows());
  std::atomic<std::size_t> done = 0;
  std::atomic<double> largest = known * known;
  parallel_tasks((count + kPointsOfTask - 1) / kPointsOfTask, [&](Index task, int) {
    stop.poll();
    Index likely = -1;
    const Index last = std::min(count, (task + 1) * kPointsOfTask);
    for (Index k = task * kPointsOfTask; k < last; ++k) {
      double square = largest.load(std::memory_order_relaxed);
      const Candidate found = find(Vector3(p.row(k)), likely, square);
      likely = found.face;
      while (found.square > square && !largest.compare_exchange_weak(square, found.square)) {
      }
    }
    stop.advance(done += to_size(kPointsOfTask), to_size(count));
  });
  return std::max(known, std::sqrt(largest.load()));
}

VertexTree::VertexTree(const Points3& points) : points_(points), tree_(boxes_of_points(points)) {}

Index VertexTree::nearest(const Vector3& p) const {
  Index best = -1;
  double least = kUnbounded;
  tree_.visit_near(p, least, [&](Index v) {
    const double square = (points_.row(v).transpose() - p).squaredNorm();
    if (!(square < least || (square == least && v < best))) return;
    least = square;
    best = v;
  });
  return best;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
