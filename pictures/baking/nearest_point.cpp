#include "majorant/pictures/baking/nearest_point.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"

namespace majorant {
namespace {

// Faces of a leaf. Chosen.
constexpr Index kLeaf = 4;
// Points that a task takes: successive ones are often neighbours.
constexpr Index kPointsOfTask = 256;
// The relative rounding of squared distances to boxes and to points in them, generously.
constexpr double kRounding = 1e-14;

using Box = Eigen::AlignedBox3d;

}  // namespace

// A binary tree: the faces of a node are those from `begin` to `end`, halved at the median of their
// middles along the longest side of its box. The first child of node k is k + 1.
struct SurfaceTree::Boxes {
  struct Node {
    Box box;
    Index begin = 0, end = 0;
    Index second = 0;  // child; 0: a leaf
  };
  std::vector<Node> nodes;
  std::vector<Index> faces;

  explicit Boxes(const std::vector<Box>& of_faces) : faces(of_faces.size()) {
    std::iota(faces.begin(), faces.end(), 0);
    nodes.reserve(faces.size());
    add(of_faces, 0, static_cast<Index>(faces.size()));
  }

 private:
  Index add(const std::vector<Box>& of_faces, Index begin, Index end) {
    const auto number = static_cast<Index>(nodes.size());
    Node node{{}, begin, end, 0};
    for (Index i = begin; i < end; ++i) node.box.extend(of_faces[to_size(faces[to_size(i)])]);
    nodes.push_back(node);
    if (end - begin <= kLeaf) return number;
    Index axis = 0;
    node.box.sizes().maxCoeff(&axis);
    const Index middle = begin + (end - begin) / 2;
    const auto center = [&](Index f) { return of_faces[to_size(f)].center()[axis]; };
    std::nth_element(
        faces.begin() + begin, faces.begin() + middle, faces.begin() + end,
        [&](Index f, Index g) { return std::pair(center(f), f) < std::pair(center(g), g); });
    add(of_faces, begin, middle);
    const Index second = add(of_faces, middle, end);
    nodes[to_size(number)].second = second;
    return number;
  }
};

NearestPoint nearest_of_triangle(const Vector3& a, const Vector3& b, const Vector3& c,
                                 const Vector3& p) {
  const std::array<Vector3, 3> corner{a, b, c};
  NearestPoint best;
  best.distance = std::numeric_limits<double>::infinity();
  const auto offer = [&](const Barycentric& xi) {
    const double distance = (a * xi[0] + b * xi[1] + c * xi[2] - p).norm();
    if (!(distance < best.distance)) return;
    best.distance = distance;
    best.barycentric = xi;
  };
  const Vector3 normal = (b - a).cross(c - a);
  Barycentric inside;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3 &q = corner[(k + 1) % 3], &r = corner[(k + 2) % 3];
    inside[static_cast<Index>(k)] = normal.dot((q - p).cross(r - p));
  }
  // Of slivers these may be all rounding: the edges have a say anyway.
  if (inside.minCoeff() > 0) offer(inside / inside.sum());
  for (Index k = 0; k < 3; ++k) {
    const Vector3& q = corner[static_cast<std::size_t>(k)];
    const Vector3 edge = corner[static_cast<std::size_t>((k + 1) % 3)] - q;
    const double squared = edge.squaredNorm();
    const double t = squared > 0 ? std::clamp((p - q).dot(edge) / squared, 0.0, 1.0) : 0.0;
    Barycentric xi = Barycentric::Zero();
    xi[k] = 1 - t;
    xi[(k + 1) % 3] = t;
    offer(xi);
  }
  return best;
}

SurfaceTree::SurfaceTree(Points3 positions, Cells faces)
    : positions_(std::move(positions)), faces_(std::move(faces)) {
  if (faces_.rows() == 0) throw InvalidArgument("SurfaceTree: no faces");
  if (!positions_.allFinite()) throw InvalidArgument("SurfaceTree: a position is not finite");
  std::vector<Box> boxes(to_size(static_cast<Index>(faces_.rows())));
  for (Index f = 0; f < faces_.rows(); ++f)
    for (Index k = 0; k < 3; ++k) boxes[to_size(f)].extend(Vector3(positions_.row(faces_(f, k))));
  boxes_ = std::make_unique<const Boxes>(boxes);
}

SurfaceTree::~SurfaceTree() = default;
SurfaceTree::SurfaceTree(SurfaceTree&&) noexcept = default;
SurfaceTree& SurfaceTree::operator=(SurfaceTree&&) noexcept = default;

NearestPoint SurfaceTree::of_face(Index face, const Vector3& p) const {
  NearestPoint point =
      nearest_of_triangle(positions_.row(faces_(face, 0)), positions_.row(faces_(face, 1)),
                          positions_.row(faces_(face, 2)), p);
  point.face = face;
  return point;
}

// Calls offer(face) with the faces in boxes that are no farther than `farthest`, which offer() may
// make smaller; nearer boxes first.
template <class Offer>
void SurfaceTree::visit_near(const Vector3& p, const double& farthest, const Offer& offer) const {
  const auto& nodes = boxes_->nodes;
  const auto distance_to = [&](Index node) {
    return nodes[to_size(node)].box.squaredExteriorDistance(p);
  };
  const auto may_be_nearer = [&](double squared) {
    return squared <= farthest * farthest * (1 + kRounding);
  };
  // Of halves one waits at each depth; medians keep that below 2 log #F.
  std::array<std::pair<Index, double>, 2 * std::numeric_limits<Index>::digits> waiting;
  std::size_t count = 0;
  waiting[count++] = {0, distance_to(0)};
  while (count > 0) {
    const auto [at, squared] = waiting[--count];
    if (!may_be_nearer(squared)) continue;
    const Boxes::Node& node = nodes[to_size(at)];
    if (node.second == 0) {
      for (Index i = node.begin; i < node.end; ++i) offer(boxes_->faces[to_size(i)]);
      continue;
    }
    std::pair<Index, double> near{at + 1, distance_to(at + 1)};
    std::pair<Index, double> far{node.second, distance_to(node.second)};
    if (far.second < near.second) std::swap(near, far);
    if (may_be_nearer(far.second)) waiting[count++] = far;
    if (may_be_nearer(near.second)) waiting[count++] = near;
  }
}

NearestPoint SurfaceTree::nearest(const Vector3& p, Index likely) const {
  NearestPoint best = of_face(likely < 0 ? 0 : likely, p);
  visit_near(p, best.distance, [&](Index face) {
    const NearestPoint other = of_face(face, p);
    if (other.distance < best.distance) best = other;
  });
  return best;
}

Vector3 SurfaceTree::doubled_normal(Index face) const {
  const auto corner = [&](Index k) -> Vector3 { return positions_.row(faces_(face, k)); };
  return (corner(1) - corner(0)).cross(corner(2) - corner(0));
}

NearestPoint SurfaceTree::nearest_facing(const Vector3& p, const Vector3& direction,
                                         double farthest, Index likely) const {
  NearestPoint best;
  best.distance = farthest;
  const auto offer = [&](Index face) {
    if (!(doubled_normal(face).dot(direction) > 0)) return;
    const NearestPoint other = of_face(face, p);
    if (other.distance < best.distance || (best.face < 0 && other.distance == best.distance))
      best = other;
  };
  if (likely >= 0) offer(likely);
  visit_near(p, best.distance, offer);
  return best;
}

NearestPoint SurfaceTree::along(const Vector3& p, const Vector3& direction, double farthest) const {
  NearestPoint best;
  best.distance = farthest;
  // A box that the line meets no farther than `best` is no farther itself: those that are left over
  // cost a test of their faces, and `farthest` is small.
  visit_near(p, best.distance, [&](Index face) {
    const Vector3 normal = doubled_normal(face);
    const double slope = normal.dot(direction);
    if (!(slope > 0)) return;
    const auto corner = [&](Index k) -> Vector3 {
      return positions_.row(faces_(face, k)).transpose() - p;
    };
    const double t = normal.dot(corner(0)) / slope;
    if (!(std::abs(t) <= best.distance)) return;
    Barycentric xi;
    for (Index k = 0; k < 3; ++k)
      xi[k] = direction.dot(corner((k + 1) % 3).cross(corner((k + 2) % 3))) / slope;
    if (!(xi.minCoeff() >= 0)) return;
    best = {face, xi / xi.sum(), std::abs(t)};
  });
  return best;
}

std::vector<Index> SurfaceTree::faces_within(const Vector3& p, double distance) const {
  const auto& nodes = boxes_->nodes;
  std::vector<Index> found, waiting{0};
  while (!waiting.empty()) {
    const Index at = waiting.back();
    waiting.pop_back();
    const Boxes::Node& node = nodes[to_size(at)];
    if (node.box.squaredExteriorDistance(p) > distance * distance * (1 + kRounding)) continue;
    if (node.second != 0) {
      waiting.push_back(at + 1);
      waiting.push_back(node.second);
      continue;
    }
    for (Index i = node.begin; i < node.end; ++i)
      if (const Index f = boxes_->faces[to_size(i)]; of_face(f, p).distance <= distance)
        found.push_back(f);
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<Index> faces_at(const SurfaceMesh& mesh, const NearestPoint& point) {
  constexpr double kOnEdge = 1e-9;
  std::vector<Index> faces = {point.face}, corners;
  for (Index k = 0; k < 3; ++k)
    if (point.barycentric[k] > kOnEdge) corners.push_back(3 * point.face + k);
  if (corners.size() == 2) {
    const Index along = next(corners[0]) == corners[1] ? corners[0] : corners[1];
    if (const Index o = mesh.opposite(along); o >= 0) faces.push_back(face_of(o));
  } else if (corners.size() == 1) {
    const auto is_other = [&](Index h) { return h >= 0 && face_of(h) != point.face; };
    for (Index h = mesh.opposite(corners[0]); is_other(h); h = mesh.opposite(next(h)))
      faces.push_back(face_of(h));
    for (Index h = mesh.opposite(previous(corners[0])); is_other(h); h = mesh.opposite(previous(h)))
      faces.push_back(face_of(h));
  }
  return faces;
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

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
