#include "majorant/parametrization/initialization/internal/vertex_descent.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <complex>
#include <initializer_list>
#include <limits>
#include <optional>
#include <utility>

#include "majorant/elements/bernstein_space.h"
#include "majorant/elements/quadrature.h"
#include "majorant/framework/backtracking.h"
#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"

namespace majorant {
namespace {

// Upper bound on the halvings of a step: less than 2^-12 of a step gains nothing.
constexpr int kMaxStepTrials = 12;
// The steps of a vertex end at a decrement below this fraction of the star's energy, a tenth of the
// tolerance of a level.
constexpr double kSmallDecrement = 1e-5;
// The smaller eigenvalue of a 2 by 2 Hessian is raised to this fraction of the larger one. It
// bounds the step where the energy is concave. Chosen, not tuned.
constexpr double kMinEigenvalueRatio = 0.05;

// Faces that a task measures; fewer are not worth waking a thread for.
constexpr Index kTaskFaces = 4096;

// Returns the term of an energy on one triangle, for its density.
std::shared_ptr<const DensityTerm> density_of(const EnergyFactory& make) {
  Cells face(1, 3);
  face << 0, 1, 2;
  RestShapes rest;
  rest.inverse = RowMatrix::Identity(2, 2).reshaped<Eigen::RowMajor>(1, 4);
  rest.measure = Vec::Constant(1, 0.5);
  return make(std::make_shared<const BezierTriangleSpace>(face, 3, 1), rest, {lattice_rule(1)});
}

// Returns -H^-1 g with a 2 by 2 Hessian whose eigenvalues are made positive.
Vector2 newton_step(const StarModel& m) {
  const double mean = (m.hxx + m.hyy) / 2, half = (m.hxx - m.hyy) / 2;
  const double radius = std::hypot(half, m.hxy);
  const double low = mean - radius, high = mean + radius;
  const double least = kMinEigenvalueRatio * std::max(std::abs(low), std::abs(high));
  const double shift = low < least ? least - low : 0;
  const double a = m.hxx + shift, c = m.hyy + shift, det = a * c - m.hxy * m.hxy;
  if (!(det > 0)) return Vector2::Zero();
  return {(m.hxy * m.gy - c * m.gx) / det, (m.hxy * m.gx - a * m.gy) / det};
}

// Upper bound on the halvings of the distance to the vertex that was collapsed onto; beyond it
// doubles do not separate the points.
constexpr int kDistanceHalvings = 50;

// The fraction of the way from an edge to the inner neighbours at which a boundary vertex is
// restored inside the image, so that the triangles outside have room too. Chosen, not tuned.
constexpr double kInwardFraction = 0.01;

using Complex = std::complex<double>;

// Returns the tangent of half the angle between two vectors.
double half_tangent(const Vector3& a, const Vector3& b) {
  return (a.norm() * b.norm() - a.dot(b)) /
         std::max(a.cross(b).norm(), std::numeric_limits<double>::min());
}

Vector2 mean_value_place(const CollapsingMesh& mesh, const Points3& positions,
                         const VertexDescent& descent, Index v) {
  const Vector3 centre = positions.row(v);
  const Index first = mesh.leaving(v);
  Vector3 edge = Vector3(positions.row(mesh.from(previous(first)))) - centre;
  Vector2 sum = Vector2::Zero();
  double total = 0;
  // The half-angle tangent of a face counts for both neighbours.
  edge = Vector3(positions.row(mesh.to(first))) - centre;
  mesh.for_each_leaving(v, [&](Index h) {
    const Index a = mesh.to(h), b = mesh.from(previous(h));
    const Vector3 other = Vector3(positions.row(b)) - centre;
    const double t = half_tangent(edge, other);
    const double wa = t / edge.norm(), wb = t / other.norm();
    sum += wa * descent.place(a) + wb * descent.place(b);
    total += wa + wb;
    edge = other;
  });
  return sum / total;
}

// Returns the place of v by the similarity that fits its neighbours best, from the star unfolded
// into the plane, with v at 0, to the map.
Vector2 unfolded_place(const CollapsingMesh& mesh, const Points3& positions,
                       const VertexDescent& descent, Index v) {
  const Vector3 centre = positions.row(v);
  std::vector<Complex> flat, image;
  const auto add = [&](Index w, const Complex& z) {
    flat.push_back(z);
    const Vector2 p = descent.place(w);
    image.emplace_back(p.x(), p.y());
  };
  Vector3 edge = Vector3(positions.row(mesh.to(mesh.leaving(v)))) - centre;
  Complex direction(1, 0);
  add(mesh.to(mesh.leaving(v)), edge.norm());
  mesh.for_each_leaving(v, [&](Index h) {
    const Index b = mesh.from(previous(h));
    const Vector3 other = Vector3(positions.row(b)) - centre;
    const Complex turn(edge.dot(other), edge.cross(other).norm());
    direction *= turn / std::abs(turn);
    add(b, other.norm() * direction);
    edge = other;
  });
  const double n = static_cast<double>(flat.size());
  Complex flat_mean = 0, image_mean = 0, product = 0;
  double square = 0;
  for (std::size_t k = 0; k < flat.size(); ++k) {
    flat_mean += flat[k] / n;
    image_mean += image[k] / n;
  }
  for (std::size_t k = 0; k < flat.size(); ++k) {
    product += std::conj(flat[k] - flat_mean) * (image[k] - image_mean);
    square += std::norm(flat[k] - flat_mean);
  }
  const Complex place = image_mean - product / square * flat_mean;
  return {place.real(), place.imag()};
}

// Returns a direction into the corner that opened at u, to the left of its two edges.
Vector2 inward(const CollapsingMesh& mesh, const VertexDescent& descent,
               const CollapsingMesh::Restored& back) {
  const Vector2 u = descent.place(back.onto);
  Vector2 sum = Vector2::Zero();
  const auto add_left_of = [&](const Vector2& edge) {
    sum += Vector2(-edge.y(), edge.x()).normalized();
  };
  mesh.for_each_leaving(back.vertex, [&](Index h) {
    if (mesh.to(h) == back.onto) add_left_of(descent.place(mesh.from(previous(h))) - u);
    if (mesh.from(previous(h)) == back.onto) add_left_of(u - descent.place(mesh.to(h)));
  });
  return sum;
}

// Puts v at u + offset, or at a fraction of it that is halved until the triangles around v have a
// margin of area.
bool put_along(VertexDescent& descent, Index v, const Vector2& u, Vector2 offset) {
  for (int k = 0; k < kDistanceHalvings; ++k, offset /= 2) {
    descent.put(v, u + offset);
    if (descent.has_area_margin(v)) return true;
  }
  return false;
}

// Puts the vertex as near as necessary to the vertex that it had collapsed onto.
bool put_near(const CollapsingMesh& mesh, VertexDescent& descent,
              const CollapsingMesh::Restored& back) {
  const Vector2 u = descent.place(back.onto);
  double distance = 0;
  mesh.for_each_leaving(back.vertex, [&](Index h) {
    distance = std::max(distance, (descent.place(mesh.to(h)) - u).norm());
  });
  return put_along(descent, back.vertex, u, distance * inward(mesh, descent, back));
}

// Puts a boundary vertex on the bisector of the corner between its faces at u, which lies inside
// the image for any angle. The distance to u is halved until the faces are positive.
bool put_into_corner(const CollapsingMesh& mesh, VertexDescent& descent,
                     const CollapsingMesh::Restored& back) {
  const Vector2 u = descent.place(back.onto);
  const auto to_complex = [](const Vector2& p) { return Complex(p.x(), p.y()); };
  double angle = 0, distance = 0;
  std::optional<Complex> first;  // direction of the neighbour where the corner begins
  mesh.for_each_leaving(back.vertex, [&](Index h) {
    const Index a = mesh.to(h), b = mesh.from(previous(h));
    if (a == back.onto || b == back.onto) return;
    const Complex one = to_complex(descent.place(a) - u), other = to_complex(descent.place(b) - u);
    if (!first) first = one;
    angle += std::arg(other / one);
    distance = std::max({distance, std::abs(one), std::abs(other)});
  });
  if (!first) return false;
  const Complex middle = std::polar(distance, std::arg(*first) + angle / 2);
  return put_along(descent, back.vertex, u, {middle.real(), middle.imag()});
}

// Returns the next and the previous boundary neighbour of a boundary vertex.
std::pair<Index, Index> boundary_neighbours(const CollapsingMesh& mesh, Index v) {
  Index last = mesh.leaving(v);
  mesh.for_each_leaving(v, [&](Index h) { last = h; });
  return {mesh.to(mesh.leaving(v)), mesh.from(previous(last))};
}

// The edge between the boundary neighbours of a vertex, with the image on its left.
struct DirectedEdge {
  Vector2 start, way;
  // Returns twice the area of the triangle with p; positive to the left.
  double area(const Vector2& p) const { return cross(way, Vector2(p - start)); }
};

DirectedEdge edge_behind(const CollapsingMesh& mesh, const VertexDescent& descent, Index v) {
  const auto [after, before] = boundary_neighbours(mesh, v);
  const Vector2 start = descent.place(before);
  return {start, descent.place(after) - start};
}

// Puts the vertex to the left of the edge where the energy around it is least. Candidates start at
// the vertex that it had collapsed onto, along the offsets and halves, quarters, ... of them.
bool put_at_best(VertexDescent& descent, const CollapsingMesh::Restored& back,
                 const DirectedEdge& edge, std::initializer_list<Vector2> offsets) {
  const Vector2 u = descent.place(back.onto);
  double least = std::numeric_limits<double>::infinity();
  Vector2 best = u;
  for (Vector2 offset : offsets)
    for (int k = 0; k < kMaxStepTrials; ++k, offset /= 2) {
      descent.put(back.vertex, u + offset);
      if (!(edge.area(u + offset) > 0) || !descent.has_area_margin(back.vertex)) continue;
      const double energy = descent.mean_energy(back.vertex);
      if (!(energy < least)) continue;
      least = energy;
      best = u + offset;
    }
  if (!std::isfinite(least)) return false;
  descent.put(back.vertex, best);
  return true;
}

// Returns the mean of a boundary vertex' neighbours that are not beside it on the boundary.
Vector2 inner_neighbours(const CollapsingMesh& mesh, const VertexDescent& descent, Index v) {
  Vector2 sum = Vector2::Zero();
  double count = 0;
  mesh.for_each_leaving(v, [&](Index h) {
    if (h == mesh.leaving(v)) return;
    sum += descent.place(mesh.to(h));
    ++count;
  });
  return sum / count;
}

}  // namespace

VertexDescent::VertexDescent(const CollapsingMesh& mesh, const Points3& positions,
                             const EnergySum& energy, Vec& uv)
    : map_(std::make_shared<Map>(Map{
          mesh, positions, uv, {}, {}, {}, {}, std::vector<Shape>(to_size(mesh.face_slots()))})) {
  if (knows_elements(energy))
    throw InvalidArgument("VertexDescent: the energy has data or weights of faces");
  for (const WeightedEnergy& e : energy) {
    map_->terms.push_back(density_of(e.make));
    map_->term_weight.push_back(e.weight);
  }
  rows_.resize(StarView::Rows * StarView::stride);
}

void VertexDescent::measure(Index f) {
  const auto corner = [&](int k) -> Vector3 {
    return map_->positions.row(map_->mesh.from(3 * f + k));
  };
  const Vector3 origin = corner(2), e1 = corner(0) - origin, e2 = corner(1) - origin;
  const double length = e1.norm(), dot = e1.dot(e2), area = e1.cross(e2).norm();
  map_->shape[f] = {1 / length, -dot / (length * area), length / area, weight_of(f) * area / 2};
}

double VertexDescent::weight_of(Index f) const {
  if (map_->face_weight.size() > 0) return map_->face_weight[f];
  if (map_->vertex_weight.size() == 0) return 1;
  return (map_->vertex_weight[map_->mesh.from(3 * f)] +
          map_->vertex_weight[map_->mesh.from(3 * f + 1)] +
          map_->vertex_weight[map_->mesh.from(3 * f + 2)]) /
         3;
}

void VertexDescent::measure_all() {
  parallel_for(map_->mesh.face_slots(), kTaskFaces, [&](Index f) {
    if (map_->mesh.has_face(f)) measure(f);
  });
}

void VertexDescent::measure_star(Index v) {
  map_->mesh.for_each_leaving(v, [&](Index h) { measure(face_of(h)); });
}

void VertexDescent::gather(Index v) {
  using S = StarView;
  count_ = 0;
  star_weight_ = 0;
  map_->mesh.for_each_leaving(v, [&](Index h) {
    const int block = count_ / S::stride, p = count_ % S::stride;
    const auto start = static_cast<std::size_t>(block * S::Rows * S::stride);
    if (rows_.size() < start + S::Rows * S::stride) rows_.resize(start + S::Rows * S::stride);
    double* row = rows_.data() + start + p;
    const Shape& s = map_->shape[face_of(h)];
    const double gx[3] = {s.g0x, 0, -s.g0x}, gy[3] = {s.g0y, s.g1y, -s.g0y - s.g1y};
    const Index a = next(h), b = previous(h);
    row[S::GaX * S::stride] = gx[corner_of(a)];
    row[S::GaY * S::stride] = gy[corner_of(a)];
    row[S::GbX * S::stride] = gx[corner_of(b)];
    row[S::GbY * S::stride] = gy[corner_of(b)];
    row[S::Weight * S::stride] = s.weight;
    const Index va = map_->mesh.from(a), vb = map_->mesh.from(b);
    row[S::AX * S::stride] = map_->uv[2 * va];
    row[S::AY * S::stride] = map_->uv[2 * va + 1];
    row[S::BX * S::stride] = map_->uv[2 * vb];
    row[S::BY * S::stride] = map_->uv[2 * vb + 1];
    star_weight_ += s.weight;
    ++count_;
  });
  // The last triangle is repeated with weight 0, up to a multiple of 8.
  const int last = (count_ - 1) % S::stride;
  double* rows =
      rows_.data() + static_cast<std::ptrdiff_t>((count_ - 1) / S::stride) * S::Rows * S::stride;
  for (int p = last + 1; p % 8 != 0; ++p)
    for (int r = 0; r < S::Rows; ++r)
      rows[r * S::stride + p] = r == S::Weight ? 0.0 : rows[r * S::stride + last];
}

StarModel VertexDescent::model(const Vector2& p) const {
  StarModel sum{0, 0, 0, 0, 0, 0, std::numeric_limits<double>::max()};
  for (int first = 0; first < count_; first += StarView::stride) {
    const StarView view{std::min(count_ - first, StarView::stride),
                        rows_.data() + static_cast<std::ptrdiff_t>(first) * StarView::Rows};
    for (std::size_t k = 0; k < map_->terms.size(); ++k) {
      const StarModel m = map_->terms[k]->star(view, p);
      const double w = map_->term_weight[k];
      sum.f += w * m.f;
      sum.gx += w * m.gx;
      sum.gy += w * m.gy;
      sum.hxx += w * m.hxx;
      sum.hxy += w * m.hxy;
      sum.hyy += w * m.hyy;
      sum.area_margin = std::min(sum.area_margin, m.area_margin);
    }
  }
  return sum;
}

bool VertexDescent::has_area_margin(Index v) {
  gather(v);
  return model(place(v)).area_margin > 0;
}

double VertexDescent::mean_energy(Index v) {
  gather(v);
  return model(place(v)).f / star_weight_;
}

template <class F>
double VertexDescent::improve(Index v, int steps, const F& is_allowed) {
  gather(v);
  Vector2 here = place(v);
  StarModel m = model(here);
  for (int step = 0; step < steps && std::isfinite(m.f); ++step) {
    const Vector2 direction = newton_step(m);
    const double slope = direction.x() * m.gx + direction.y() * m.gy;
    if (!(slope < -kSmallDecrement * std::abs(m.f))) break;
    const auto attempt = [&](double s) {
      const Vector2 there = here + s * direction;
      const StarModel trial = model(there);
      if (!is_allowed(there) || !(trial.area_margin > 0) || !(trial.f <= m.f + kArmijo * s * slope))
        return kHalve;
      here = there;
      m = trial;
      return kTake;
    };
    if (!backtrack(1, {.most_trials = kMaxStepTrials}, attempt)) break;
  }
  put(v, here);
  return m.f / star_weight_;
}

double VertexDescent::improve(Index v, int steps) {
  return improve(v, steps, [](const Vector2&) { return true; });
}

double VertexDescent::improve_within(Index v, int steps) {
  const DirectedEdge edge = edge_behind(map_->mesh, *this, v);
  const double least = edge.area(place(v)) / 2;
  if (!(least > 0)) return mean_energy(v);
  return improve(v, steps, [&](const Vector2& p) { return edge.area(p) >= least; });
}

bool put_back(const CollapsingMesh& mesh, const Points3& positions, VertexDescent& descent,
              const CollapsingMesh::Restored& back) {
  const Index v = back.vertex;
  descent.put(v, mesh.on_boundary(v) ? unfolded_place(mesh, positions, descent, v)
                                     : mean_value_place(mesh, positions, descent, v));
  return descent.has_area_margin(v) || put_near(mesh, descent, back);
}

bool put_back_within(const CollapsingMesh& mesh, const Points3& positions, VertexDescent& descent,
                     const CollapsingMesh::Restored& back) {
  const Index v = back.vertex;
  if (!mesh.on_boundary(v)) return put_back(mesh, positions, descent, back);
  const auto [after, before] = boundary_neighbours(mesh, v);
  const Index other = after == back.onto ? before : after;
  const auto length = [&](Index w) { return (positions.row(w) - positions.row(v)).norm(); };
  const double part = length(back.onto) / (length(back.onto) + length(other));
  const Vector2 u = descent.place(back.onto);
  const Vector2 on_edge = part * (descent.place(other) - u);
  const Vector2 inner = inner_neighbours(mesh, descent, v) - u;
  const Vector2 beside = on_edge + kInwardFraction * (inner - on_edge);
  // If the corner that opened is reflex, no place inside the edge has room; places near the vertex
  // are then within the image.
  return put_at_best(descent, back, edge_behind(mesh, descent, v),
                     {beside, on_edge.norm() * inward(mesh, descent, back)}) ||
         put_into_corner(mesh, descent, back);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
