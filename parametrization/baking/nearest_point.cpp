#include "majorant/parametrization/baking/nearest_point.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>
#include <limits>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"

namespace majorant {
namespace {

namespace geometry = boost::geometry;
using TreePoint = geometry::model::point<double, 3, geometry::cs::cartesian>;
using TreeBox = geometry::model::box<TreePoint>;
using TreeEntry = std::pair<TreeBox, Index>;

// Boxes of a leaf. Measured with 16 to 32: the same.
constexpr std::size_t kLeaf = 16;
// Points that a task takes: successive ones are often neighbours.
constexpr Index kPointsOfTask = 256;
// The relative rounding of squared distances to boxes and to points in them, generously.
constexpr double kRounding = 1e-14;

TreePoint tree_point(const Vector3& p) { return {p.x(), p.y(), p.z()}; }

}  // namespace

struct SurfaceTree::Boxes {
  geometry::index::rtree<TreeEntry, geometry::index::quadratic<kLeaf>> tree;
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
  std::vector<TreeEntry> entries;
  entries.reserve(to_size(static_cast<Index>(faces_.rows())));
  for (Index f = 0; f < faces_.rows(); ++f) {
    Vector3 low = positions_.row(faces_(f, 0)), high = low;
    for (Index k = 1; k < 3; ++k) {
      low = low.cwiseMin(positions_.row(faces_(f, k)).transpose());
      high = high.cwiseMax(positions_.row(faces_(f, k)).transpose());
    }
    entries.emplace_back(TreeBox(tree_point(low), tree_point(high)), f);
  }
  boxes_ = std::make_unique<const Boxes>(Boxes{decltype(Boxes::tree)(entries)});
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

NearestPoint SurfaceTree::nearest(const Vector3& p, Index likely) const {
  NearestPoint best = of_face(likely < 0 ? 0 : likely, p);
  const TreePoint at = tree_point(p);
  const auto offer = [&](const TreeEntry& entry) {
    if (geometry::comparable_distance(at, entry.first) >
        best.distance * best.distance * (1 + kRounding))
      return;
    const NearestPoint other = of_face(entry.second, p);
    if (other.distance < best.distance) best = other;
  };
  // The face of the nearest box is near, and nothing that is nearer lies outside of the cube around
  // the point that its distance makes. An incremental query costs hundreds of times as much.
  boxes_->tree.query(geometry::index::nearest(at, 1), boost::make_function_output_iterator(offer));
  const Vector3 reach = Vector3::Constant(best.distance * (1 + kRounding));
  const TreeBox around(tree_point(p - reach), tree_point(p + reach));
  boxes_->tree.query(geometry::index::intersects(around),
                     boost::make_function_output_iterator(offer));
  return best;
}

std::vector<NearestPoint> SurfaceTree::locate(const Points3& p, const StopCheck& stop) const {
  const auto count = static_cast<Index>(p.rows());
  std::vector<NearestPoint> result(to_size(count));
  parallel_tasks((count + kPointsOfTask - 1) / kPointsOfTask, [&](Index task, int) {
    stop.poll();
    Index likely = -1;
    const Index last = std::min(count, (task + 1) * kPointsOfTask);
    for (Index k = task * kPointsOfTask; k < last; ++k) {
      result[to_size(k)] = nearest(Vector3(p.row(k)), likely);
      likely = result[to_size(k)].face;
    }
  });
  return result;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
