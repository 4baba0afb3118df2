#include "majorant/parametrization/solve/internal/boundary_barrier.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "majorant/certify/global_injectivity.h"
#include "majorant/framework/terms/local_term.h"
#include "majorant/mesh/box_tree.h"
#include "majorant/mesh/geometry.h"

namespace majorant {
namespace {

// Edges shorter than this fraction of the mean boundary edge count as this long.
constexpr double kLeastLength = 1e-8;
// Steps are searched for contacts in growing parts, since the boxes of short parts meet few others.
// In the first one vertices move by at most this many mean boundary edges.
constexpr double kFirstWay = 4, kNextPart = 8;
// Rounding of the place of a contact along an edge.
constexpr double kAlongRounding = 1e-9;

Vector2 point(VecIn x, Index v) { return x.segment<2>(2 * v); }

double squared_distance(const Vector2& p, const Vector2& a, const Vector2& b) {
  const Vector2 edge = b - a, r = p - a;
  const double square = edge.squaredNorm();
  const double t = square > 0 ? std::clamp(r.dot(edge) / square, 0.0, 1.0) : 0.0;
  return (r - t * edge).squaredNorm();
}

// Returns the first t in (0, s) at which the vertex meets the edge, or s. a, b, v: their places;
// da, db, dv: their velocities.
double contact_time(const Vector2& v, const Vector2& dv, const Vector2& a, const Vector2& da,
                    const Vector2& b, const Vector2& db, double s) {
  const Vector2 e = b - a, r = v - a, de = db - da, dr = dv - da;
  // The vertex is on the line of the edge at the roots of A t^2 + B t + C.
  const double A = cross(de, dr), B = cross(e, dr) + cross(de, r), C = cross(e, r);
  const double square = B * B - 4 * A * C;
  if (square < 0) return s;
  const double q = -0.5 * (B + std::copysign(std::sqrt(square), B));
  for (const double t : {q / A, C / q}) {
    if (!(t > 0 && t < s)) continue;
    const Vector2 along = e + t * de;
    const double place = along.dot(r + t * dr) / along.squaredNorm();
    if (place >= -kAlongRounding && place <= 1 + kAlongRounding) s = t;
  }
  return s;
}

}  // namespace

BoundaryEdges::BoundaryEdges(const BezierMap& map, double scale) {
  const SurfaceMesh& mesh = map.mesh();
  std::vector<Index> from, to;
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (mesh.opposite(h) < 0) {
      from.push_back(mesh.from_vertex(h));
      to.push_back(mesh.to_vertex(h));
    }
  const auto count = static_cast<Index>(from.size());
  ends_.resize(count, 2);
  length_.resize(count);
  edge_.assign(to_size(mesh.vertex_count()), -1);
  for (Index k = 0; k < count; ++k) {
    ends_.row(k) << from[k], to[k];
    length_[k] = scale * (mesh.positions().row(to[k]) - mesh.positions().row(from[k])).norm();
    edge_[from[k]] = k;
  }
  size_ = scale * std::sqrt(mesh.area());
  const double least = count > 0 ? kLeastLength * length_.mean() : 0;
  length_ = length_.cwiseMax(least);
  length_at_ = Vec::Zero(mesh.vertex_count());
  for (Index k = 0; k < count; ++k)
    for (const Index v : ends_.row(k)) length_at_[v] += 0.5 * length_[k];
  vertex_ = std::move(from);
}

double BoundaryEdges::of_pair(Index vertex, Index edge, const BarrierReach& reach) const {
  return std::min(reach.of_edges * std::min(length_at_[vertex], length_[edge]),
                  reach.of_size * size_);
}

Cells BoundaryEdges::near_pairs(VecIn x, const BarrierReach& reach, double factor) const {
  std::vector<Box2> boxes;
  for (const auto& e : ends_.rowwise()) {
    const Vector2 a = point(x, e[0]), b = point(x, e[1]);
    boxes.push_back({a.cwiseMin(b), a.cwiseMax(b)});
  }
  const BoxTree<2> tree(std::move(boxes));
  std::vector<std::array<Index, 2>> found;
  for (const Index v : vertex_) {
    const Vector2 p = point(x, v),
                  far = Vector2::Constant(
                      factor * std::min(reach.of_edges * length_at_[v], reach.of_size * size_));
    tree.visit_meeting({p - far, p + far}, [&](Index e) {
      const Index a = ends_(e, 0), b = ends_(e, 1);
      if (v == a || v == b) return;
      const double limit = factor * of_pair(v, e, reach);
      if (squared_distance(p, point(x, a), point(x, b)) <= limit * limit) found.push_back({v, e});
    });
  }
  std::sort(found.begin(), found.end());
  Cells pairs(static_cast<Index>(found.size()), 3);
  for (std::size_t k = 0; k < found.size(); ++k)
    pairs.row(static_cast<Index>(k)) << found[k][0], ends_(found[k][1], 0), ends_(found[k][1], 1);
  return pairs;
}

std::shared_ptr<const EnergyTerm> BoundaryEdges::barrier(const Cells& pairs,
                                                         const BarrierReach& reach) const {
  RowMatrix data(pairs.rows(), 2);
  for (Index k = 0; k < pairs.rows(); ++k) {
    const double r = of_pair(pairs(k, 0), edge_[pairs(k, 1)], reach);
    data.row(k) << 1 / (r * r), r * length_at_[pairs(k, 0)];
  }
  return make_term<3, 2>(
      "boundary-barrier", pairs,
      [](const auto& z, const auto& pair) {
        using std::log, std::min, std::max;
        using T = typename std::decay_t<decltype(z)>::Scalar;
        const auto edge = (z.col(2) - z.col(1)).eval(), r = (z.col(0) - z.col(1)).eval();
        const T t = min(max(T(r.dot(edge) / edge.squaredNorm()), T(0.0)), T(1.0));
        const T s = min(T((r - t * edge).squaredNorm() * pair[0]), T(1.0));
        return T(-(s - 1.0) * (s - 1.0) * log(s) * pair[1]);
      },
      data);
}

SimpleBoundary::SimpleBoundary(std::shared_ptr<const BoundaryEdges> edges, BezierMap map)
    : edges_(std::move(edges)), map_(std::move(map)) {}

Verdict SimpleBoundary::check(VecIn x) const {
  const auto proof = check_boundary(map_.with(map_.shared_space(), Vec(x)));
  return {proof.result == ProofStatus::Proven, 0, {}, {}};
}

StepBound SimpleBoundary::max_step(VecIn x, VecIn d, double s) const {
  const double way = d.size() > 0 ? d.cwiseAbs().maxCoeff() : 0;
  for (double part = kFirstWay * edges_->mean_length() / way; part > 0 && part < s;
       part *= kNextPart) {
    StepBound bound = first_contact(x, d, part);
    if (bound.step < part) return bound;
  }
  return first_contact(x, d, s);
}

StepBound SimpleBoundary::first_contact(VecIn x, VecIn d, double s) const {
  const Cells& ends = edges_->ends();
  const auto swept = [&](Index v) -> Box2 {
    const Vector2 p = point(x, v), q = p + s * point(d, v);
    return {p.cwiseMin(q), p.cwiseMax(q)};
  };
  std::vector<Box2> boxes;
  for (const auto& e : ends.rowwise()) {
    const Box2 a = swept(e[0]), b = swept(e[1]);
    boxes.push_back({a.low.cwiseMin(b.low), a.high.cwiseMax(b.high)});
  }
  const BoxTree<2> tree(std::move(boxes));
  StepBound bound{s, {}};
  for (const Index v : edges_->vertices())
    tree.visit_meeting(swept(v), [&](Index e) {
      const Index a = ends(e, 0), b = ends(e, 1);
      if (v == a || v == b) return;
      const double t = contact_time(point(x, v), point(d, v), point(x, a), point(d, a), point(x, b),
                                    point(d, b), bound.step);
      if (t < bound.step) bound = {t, {map_.space().element_count() + e}};
    });
  return bound;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
