#include "majorant/parametrization/conformal_energy.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace majorant {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// Adds (u_a + u_b) / 2 to every half-edge.
Vec scaled_by(const SurfaceMesh& mesh, Vec log_lengths, const Vec& u) {
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    log_lengths[h] += 0.5 * (u[mesh.from_vertex(h)] + u[mesh.to_vertex(h)]);
  return log_lengths;
}

}  // namespace

// Half-angle formula with s - a, s - b, s - c computed from the sorted sides a >= b >= c in
// Kahan's order, which cancels no digits that the sides have.
TriangleShape triangle_shape(const std::array<double, 3>& log_sides) {
  std::array<std::size_t, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(),
            [&](std::size_t i, std::size_t k) { return log_sides[i] > log_sides[k]; });
  const double unit = log_sides[order[0]];  // the longest side becomes 1: no overflow
  const double a = 1, b = std::exp(log_sides[order[1]] - unit),
               c = std::exp(log_sides[order[2]] - unit);
  // Twice s, s - a, s - b, s - c.
  const double perimeter = a + (b + c);
  const std::array<double, 3> rest{c - (a - b), c + (a - b), a + (b - c)};

  TriangleShape shape;
  // Four times the area; 0 also where the product underflows, and such a needle counts as broken.
  const double four_areas = std::sqrt(perimeter * rest[2]) * std::sqrt(rest[1] * rest[0]);
  if (!(rest[0] > 0) || !(four_areas > std::numeric_limits<double>::min())) {
    shape.angle[order[0]] = std::numbers::pi;
    shape.log_area = -std::numeric_limits<double>::infinity();
    shape.broken = true;
    return shape;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const double opposite = perimeter * rest[k], adjacent = rest[(k + 1) % 3] * rest[(k + 2) % 3];
    shape.angle[order[k]] = 2 * std::atan2(std::sqrt(adjacent), std::sqrt(opposite));
    shape.cotangent[order[k]] = (opposite - adjacent) / (2 * four_areas);
  }
  shape.log_area = std::log(four_areas / 4) + 2 * unit;
  return shape;
}

Vec log_edge_lengths(const SurfaceMesh& mesh) {
  Vec lengths(mesh.half_edge_count());
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    lengths[h] = std::log(
        (mesh.positions().row(mesh.to_vertex(h)) - mesh.positions().row(mesh.from_vertex(h)))
            .norm());
  return lengths;
}

Vec log_edge_lengths(const SurfaceMesh& mesh, const Vec& log_factor) {
  return scaled_by(mesh, log_edge_lengths(mesh), log_factor);
}

TriangleShape face_shape(const Vec& log_lengths, Index f) {
  // Half-edge k runs from corner k to corner k + 1, opposite corner k + 2.
  return triangle_shape({log_lengths[3 * f + 1], log_lengths[3 * f + 2], log_lengths[3 * f]});
}

ConformalEnergy::ConformalEnergy(const SurfaceMesh& mesh, Vec wanted_angles)
    : mesh_(mesh),
      wanted_angles_(std::move(wanted_angles)),
      log_lengths_(log_edge_lengths(mesh)),
      is_interior_(at(mesh.vertex_count()), 1) {
  for (const auto& loop : mesh.boundary_loops())
    for (const Index v : loop) is_interior_[at(v)] = 0;
}

ConformalDerivatives ConformalEnergy::derivatives(const Vec& log_factor) const {
  const Vec lengths = scaled_by(mesh_, log_lengths_, log_factor);
  ConformalDerivatives out{wanted_angles_, Vec(mesh_.half_edge_count())};
  for (Index f = 0; f < mesh_.face_count(); ++f) {
    const TriangleShape shape = face_shape(lengths, f);
    for (Index k = 0; k < 3; ++k) {
      out.gradient[mesh_.faces()(f, k)] -= shape.angle[at(k)];
      out.hessian_weights[3 * f + k] = 0.5 * shape.cotangent[at((k + 2) % 3)];
    }
  }
  for (Index v = 0; v < mesh_.vertex_count(); ++v)
    if (!is_interior_[at(v)]) out.gradient[v] = 0;
  return out;
}

}  // namespace majorant
