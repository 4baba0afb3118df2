#include "majorant/parametrization/initialization/internal/reinsertion.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

namespace majorant {
namespace {

// Halvings of the distance to the vertex that was collapsed onto: beyond them, doubles
// cannot tell the points apart.
constexpr int kDistanceHalvings = 50;

using Complex = std::complex<double>;

// Tangent of half the angle between two vectors.
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
  // Face by face: its half-angle tangent counts for both neighbours.
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

// The star unfolded into the plane with v at 0, and the similarity from there to the map that fits
// its neighbours best.
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

// Into the corner that opened at u: to the left of the edges that bound it.
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

}  // namespace

bool put_back(const CollapsingMesh& mesh, const Points3& positions, VertexDescent& descent,
              const CollapsingMesh::Restored& back) {
  const Index v = back.vertex;
  descent.put(v, mesh.on_boundary(v) ? unfolded_place(mesh, positions, descent, v)
                                     : mean_value_place(mesh, positions, descent, v));
  if (descent.has_area_margin(v)) return true;
  const Vector2 u = descent.place(back.onto), direction = inward(mesh, descent, back);
  double distance = 0;
  mesh.for_each_leaving(
      v, [&](Index h) { distance = std::max(distance, (descent.place(mesh.to(h)) - u).norm()); });
  for (int k = 0; k < kDistanceHalvings; ++k, distance /= 2) {
    descent.put(v, u + distance * direction);
    if (descent.has_area_margin(v)) return true;
  }
  return false;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
