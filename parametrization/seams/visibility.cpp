#include "majorant/parametrization/seams/visibility.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "majorant/framework/parallel.h"
#include "majorant/mesh/box_tree.h"
#include "majorant/mesh/geometry.h"
#include "majorant/mesh/model_unit.h"
#include "majorant/parametrization/seams/internal/cut_costs.h"

namespace majorant {
namespace {

// Upper bound on vertices from which rays are sent: more than there are features that hide a seam.
constexpr Index kMaxSamples = 4000;
// Cells along each side of the cube around a vertex; rays go through their centres, 96 in all. The
// number is even, so that no direction has a zero coordinate.
constexpr int kCells = 4;
// The height above a vertex at which a ray starts, relative to the diagonal of the surface: above
// rounding, below any feature that occludes.
constexpr double kRayStartHeight = 1e-3;
// Rounds in which visibility is replaced by the mean over neighbours.
constexpr int kSmoothings = 2;
// The weight of hidden edges, relative to that of edges in full view; positive, so that no path is
// free. Cuts of public meshes hardly change from a hundredth on.
constexpr double kHiddenWeight = 0.02;

// A surface that occludes rays.
class OccludingSurface {
 public:
  explicit OccludingSurface(const SurfaceMesh& mesh)
      : mesh_(mesh), tree_(boxes_of_faces(mesh.positions(), mesh.faces())) {}

  bool meets(const Vector3& from, const Vector3& direction) const {
    bool is_met = false;
    tree_.visit_along({from, direction}, 0, [&](Index face) {
      is_met = meets_face(face, from, direction);
      return !is_met;
    });
    return is_met;
  }

 private:
  Vector3 corner(Index f, Index k) const { return mesh_.positions().row(mesh_.faces()(f, k)); }

  // Returns whether the ray meets the face, from either side [MT97].
  bool meets_face(Index f, const Vector3& from, const Vector3& direction) const {
    const Vector3 a = corner(f, 0), e = corner(f, 1) - a, g = corner(f, 2) - a;
    const Vector3 p = direction.cross(g);
    const double det = e.dot(p);
    if (det == 0) return false;
    const Vector3 s = from - a, q = s.cross(e);
    const double u = s.dot(p) / det, v = direction.dot(q) / det;
    return u >= 0 && v >= 0 && u + v <= 1 && g.dot(q) / det > 0;
  }

  const SurfaceMesh& mesh_;
  const BoxTree<3> tree_;
};

struct Direction {
  Vector3 towards;  // of length 1
  double weight;    // its solid angle, up to a common factor
};

std::vector<Direction> directions() {
  std::vector<Direction> all;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0})
      for (int i = 0; i < kCells; ++i)
        for (int j = 0; j < kCells; ++j) {
          Vector3 d;
          d[axis] = side;
          d[(axis + 1) % 3] = (2 * i + 1.0) / kCells - 1;
          d[(axis + 2) % 3] = (2 * j + 1.0) / kCells - 1;
          const double length = d.norm();
          all.push_back({d / length, 1 / (length * length * length)});
        }
  return all;
}

Points3 vertex_normals(const SurfaceMesh& mesh) {
  Points3 normals = Points3::Zero(mesh.vertex_count(), 3);
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (Index k = 0; k < 3; ++k)
      normals.row(mesh.faces()(f, k)) += area_vector(mesh, f).transpose();
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    normals.row(v) = normals.row(v).stableNormalized().eval();
  return normals;
}

// Returns for each vertex its neighbours along edges; those along edges of two faces are repeated.
std::vector<std::vector<Index>> neighbours(const SurfaceMesh& mesh) {
  std::vector<std::vector<Index>> all(to_size(mesh.vertex_count()));
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    all[to_size(mesh.from_vertex(h))].push_back(mesh.to_vertex(h));
    if (mesh.opposite(h) < 0) all[to_size(mesh.to_vertex(h))].push_back(mesh.from_vertex(h));
  }
  return all;
}

// Sample vertices and the assignment of every vertex to the sample that is nearest along edges.
class Samples {
 public:
  // Samples every k-th vertex, at most kMaxSamples, and the first one of each component without
  // samples.
  explicit Samples(const SurfaceMesh& mesh) : nearest_(to_size(mesh.vertex_count()), -1) {
    const Index stride = (mesh.vertex_count() + kMaxSamples - 1) / kMaxSamples;
    for (Index v = 0; v < mesh.vertex_count(); v += std::max<Index>(stride, 1)) add(v);
    if (stride <= 1) return;
    const std::vector<std::vector<Index>> around = neighbours(mesh);
    grow(around);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      if (nearest_[to_size(v)] >= 0) continue;
      add(v);
      grow(around);
    }
  }

  const std::vector<Index>& vertices() const { return vertices_; }

  // Returns values of all vertices (#V) from those of the samples.
  Vec spread(const Vec& value) const {
    Vec all(static_cast<Index>(nearest_.size()));
    for (Index v = 0; v < all.size(); ++v) all[v] = value[nearest_[to_size(v)]];
    return all;
  }

 private:
  void add(Index v) {
    nearest_[to_size(v)] = static_cast<Index>(vertices_.size());
    vertices_.push_back(v);
    reached_.push_back(v);
  }
  void grow(const std::vector<std::vector<Index>>& around) {
    for (; grown_ < reached_.size(); ++grown_)
      for (const Index w : around[to_size(reached_[grown_])]) {
        if (nearest_[to_size(w)] >= 0) continue;
        nearest_[to_size(w)] = nearest_[to_size(reached_[grown_])];
        reached_.push_back(w);
      }
  }

  std::vector<Index> nearest_;  // #V: the number of the sample
  std::vector<Index> vertices_;
  std::vector<Index> reached_;  // vertices, in the order of their distance
  std::size_t grown_ = 0;       // of these, the ones whose neighbours are reached
};

// Rays that start a little above vertices.
class RaysFrom {
 public:
  explicit RaysFrom(const SurfaceMesh& mesh)
      : positions_(mesh.positions()),
        occluders_(mesh),
        normals_(vertex_normals(mesh)),
        height_(kRayStartHeight * diagonal(mesh.positions())) {}

  Vector3 normal(Index v) const { return normals_.row(v); }
  bool leaves(Index v, const Vector3& direction) const {
    return !occluders_.meets(positions_.row(v).transpose() + height_ * normal(v), direction);
  }

 private:
  const Points3& positions_;
  const OccludingSurface occluders_;
  const Points3 normals_;
  const double height_;
};

void smooth(const SurfaceMesh& mesh, Vec& value) {
  for (int k = 0; k < kSmoothings; ++k) {
    Vec sum = value, count = Vec::Ones(value.size());
    for (Index h = 0; h < mesh.half_edge_count(); ++h) {
      sum[mesh.from_vertex(h)] += value[mesh.to_vertex(h)];
      count[mesh.from_vertex(h)] += 1;
    }
    value = sum.cwiseQuotient(count);
  }
}

// Returns `visibility` of a mesh that is scaled so that its extent is of moderate size.
template <class Visibility>
Vec near_one(const SurfaceMesh& mesh, const Visibility& visibility) {
  const double unit = model_unit(mesh);
  return unit == 1 ? visibility(mesh) : visibility(*in_units(mesh, unit));
}

}  // namespace

Vec ambient_visibility(const SurfaceMesh& surface, const StopCheck& stop) {
  return near_one(surface, [&stop](const SurfaceMesh& mesh) {
    const RaysFrom rays(mesh);
    const Samples samples(mesh);
    const std::vector<Direction> light = directions();
    Vec visibility = Vec::Ones(static_cast<Index>(samples.vertices().size()));
    parallel_for(visibility.size(), 16, [&](Index sample) {
      if (sample % 16 == 0) {
        stop.poll();
        stop.advance(to_size(sample), samples.vertices().size());
      }
      const Index v = samples.vertices()[to_size(sample)];
      double seen = 0, all = 0;
      for (const Direction& d : light) {
        const double weight = d.weight * d.towards.dot(rays.normal(v));
        if (weight <= 0) continue;
        all += weight;
        if (rays.leaves(v, d.towards)) seen += weight;
      }
      if (all > 0) visibility[sample] = seen / all;
    });
    visibility = samples.spread(visibility);
    smooth(mesh, visibility);
    return visibility;
  });
}

Vec visibility_from(const SurfaceMesh& surface, const Vector3& direction, const StopCheck& stop) {
  const Vector3 towards = direction.stableNormalized();
  return near_one(surface, [&](const SurfaceMesh& mesh) {
    const RaysFrom rays(mesh);
    Vec visibility(mesh.vertex_count());
    parallel_for(mesh.vertex_count(), 256, [&](Index v) {
      if (v % 256 == 0) {
        stop.poll();
        stop.advance(to_size(v), to_size(mesh.vertex_count()));
      }
      const double cosine = towards.dot(rays.normal(v));
      visibility[v] = cosine > 0 && rays.leaves(v, towards) ? cosine : 0;
    });
    return visibility;
  });
}

std::vector<double> hiding_weights(const SurfaceMesh& mesh, const Vec& visibility) {
  std::vector<double> weight(to_size(mesh.half_edge_count()));
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const double seen = 0.5 * (visibility[mesh.from_vertex(h)] + visibility[mesh.to_vertex(h)]);
    weight[to_size(h)] = kHiddenWeight + (1 - kHiddenWeight) * seen * seen;
  }
  return weight;
}

double visibility_of_cuts(const SurfaceMesh& mesh, const Vec& visibility,
                          const std::vector<char>& is_cut) {
  double sum = 0, length = 0;
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    if (!is_cut[to_size(h)]) continue;
    sum += mesh.edge_length(h) * 0.5 *
           (visibility[mesh.from_vertex(h)] + visibility[mesh.to_vertex(h)]);
    length += mesh.edge_length(h);
  }
  if (length > 0) return sum / length;
  double area = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const double twice = area_vector(mesh, f).norm();
    for (Index k = 0; k < 3; ++k) sum += twice / 3 * visibility[mesh.faces()(f, k)];
    area += twice;
  }
  return area > 0 ? sum / area : 1;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
