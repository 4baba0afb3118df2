#include "majorant/parametrization/fields/internal/intrinsic_triangulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "majorant/mesh/half_edge_flip.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {
namespace {

using Complex = std::complex<double>;

// Upper bound on flips per call and triangle, five times the number that random log factors of +-20
// need. It prevents endless cycles where lengths agree up to rounding.
constexpr Index kMaxFlipsPerTriangle = 20;

// Values of twice the sum of the cosines of opposite angles below this count as 0. That is the
// value for four points on a circle, where both diagonals are Delaunay. Angles of needles have a
// few digits less than doubles. Chosen, not tuned.
constexpr double kCocircular = 1e-10;

// Upper bound on logarithms of lengths that are exponentiated, beyond those of all surfaces. If no
// metric was found they may have any value; with the bound, products of two lengths stay in the
// range of doubles.
constexpr double kLargestLog = 300;

// Returns log(e^x + e^y).
double log_sum(double x, double y) {
  return std::max(x, y) + std::log1p(std::exp(-std::abs(x - y)));
}

Complex vector_of(const Points2& vectors, Index h) { return {vectors(h, 0), vectors(h, 1)}; }
void set_vector(Points2& vectors, Index h, Complex z) { vectors.row(h) << z.real(), z.imag(); }

// Returns the rotation from the frame of the triangle at `there` to that at `here`, where both
// sides of their edge have opposite directions; 1 if the edge has no length.
Complex rotation_between(Complex here, Complex there) {
  const Complex product = -here * std::conj(there);
  return std::abs(product) > 0 ? product / std::abs(product) : Complex(1);
}

}  // namespace

// Uses the half-angle formula, with s - a, s - b, s - c computed from the sorted sides a >= b >= c
// in Kahan's order, which loses no digits of the sides.
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
  // Four times the area. If the product underflows it is 0, and such a needle counts as broken.
  const double four_areas = std::sqrt(perimeter * rest[2]) * std::sqrt(rest[1] * rest[0]);
  if (!(rest[0] > 0) || !(four_areas > std::numeric_limits<double>::min())) {
    shape.angle[order[0]] = std::numbers::pi;
    shape.log_area = -std::numeric_limits<double>::infinity();
    shape.broken = true;
    return shape;
  }
  for (Index k = 0; k < 3; ++k) {
    const double opposite = perimeter * rest[k];
    const double adjacent = rest[next(k)] * rest[previous(k)];
    shape.angle[order[k]] = 2 * std::atan2(std::sqrt(adjacent), std::sqrt(opposite));
    shape.cotangent[order[k]] = (opposite - adjacent) / (2 * four_areas);
  }
  shape.log_area = std::log(four_areas / 4) + 2 * unit;
  return shape;
}

IntrinsicTriangulation::IntrinsicTriangulation(const SurfaceMesh& mesh)
    : faces_(mesh.faces()), log_lengths_(mesh.half_edge_count()) {
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    opposite_.push_back(mesh.opposite(h));
    log_lengths_[h] = std::log(
        (mesh.positions().row(mesh.to_vertex(h)) - mesh.positions().row(mesh.from_vertex(h)))
            .norm());
  }
}

Vec IntrinsicTriangulation::log_lengths(const Vec& log_factor) const {
  Vec lengths(half_edge_count());
  for (Index h = 0; h < half_edge_count(); ++h) lengths[h] = log_length(log_factor, h);
  return lengths;
}

double IntrinsicTriangulation::log_length(const Vec& log_factor, Index h) const {
  return log_lengths_[h] +
         0.5 * (log_factor[from_vertex(faces_, h)] + log_factor[to_vertex(faces_, h)]);
}

bool IntrinsicTriangulation::has_broken_triangles(const Vec& log_factor) const {
  const Vec lengths = log_lengths(log_factor);
  for (Index f = 0; f < face_count(); ++f)
    if (shape(lengths, f).broken) return true;
  return false;
}

TriangleShape IntrinsicTriangulation::shape(const Vec& log_lengths, Index f) {
  // Half-edge k runs from corner k to corner k + 1, opposite corner k + 2.
  return triangle_shape({log_lengths[3 * f + 1], log_lengths[3 * f + 2], log_lengths[3 * f]});
}

// Returns whether the sum of the cosines of the two angles opposite the edge is positive, by the
// law of cosines. For broken triangles its values lie outside [-1, 1] but keep that meaning.
bool IntrinsicTriangulation::is_delaunay(const Vec& log_lengths, Index half_edge) const {
  const auto twice_cosine = [&](Index h) {
    const double a = log_lengths[h], b = log_lengths[next(h)], c = log_lengths[previous(h)];
    return std::exp(b - c) + std::exp(c - b) - std::exp(2 * a - b - c);
  };
  return !(twice_cosine(half_edge) + twice_cosine(opposite(half_edge)) < -kCocircular);
}

// Flips the edge a -> b, with c on this side and d on the other. Before: here a->b, b->c, c->a;
// there b->a, a->d, d->b. After: here d->c, c->a, a->d; there c->d, d->b, b->c.
void IntrinsicTriangulation::flip(Index half_edge) {
  const Index h0 = half_edge, h1 = next(h0), h2 = previous(h0);
  const Index o0 = opposite(half_edge), o1 = next(o0), o2 = previous(o0);
  const double diagonal =
      log_sum(log_lengths_[h1] + log_lengths_[o1], log_lengths_[h2] + log_lengths_[o2]) -
      log_lengths_[h0];
  const FlippedSides moved = flip_half_edge(faces_, opposite_, half_edge);
  std::array<double, 4> lengths{};
  for (std::size_t k = 0; k < 4; ++k) lengths[k] = log_lengths_[moved.from[k]];
  for (std::size_t k = 0; k < 4; ++k) log_lengths_[moved.to[k]] = lengths[k];
  log_lengths_[h0] = log_lengths_[o0] = diagonal;
  flips_.push_back({h0, o0});
}

Index IntrinsicTriangulation::make_delaunay(const Vec& log_factor) {
  Vec lengths = log_lengths(log_factor);
  std::vector<Index> half_edges;
  for (Index h = 0; h < half_edge_count(); ++h) half_edges.push_back(h);
  Index flipped = 0;
  while (!half_edges.empty() && flipped < kMaxFlipsPerTriangle * face_count()) {
    const Index h = half_edges.back(), o = opposite(h);
    half_edges.pop_back();
    if (o < 0 || face_of(o) == face_of(h) || is_delaunay(lengths, h)) continue;
    flip(h);
    ++flipped;
    for (const Index first : {3 * (face_of(h)), 3 * (face_of(o))})
      for (Index side = first; side < first + 3; ++side) {
        lengths[side] = log_length(log_factor, side);
        half_edges.push_back(side);
      }
  }
  return flipped;
}

Points2 IntrinsicTriangulation::surface_vectors(const Vec& log_factor) const {
  const Vec lengths = log_lengths(log_factor);
  Points2 vectors(half_edge_count(), 2);
  for (Index f = 0; f < face_count(); ++f) {
    const TriangleShape triangle = shape(lengths, f);
    Complex direction = 1;
    for (Index k = 0; k < 3; ++k) {
      const double turn = std::numbers::pi - triangle.angle[next(k)];
      const double length = std::clamp(lengths[3 * f + k], -kLargestLog, kLargestLog);
      set_vector(vectors, 3 * f + k, std::exp(length) * direction);
      // The direction is exactly straight at a broken triangle's corners of 0 and pi.
      direction *= !triangle.broken ? std::polar(1.0, turn) : turn > 1 ? Complex(-1) : Complex(1);
    }
  }
  // Flips are undone in reverse order: the two triangles are brought into one frame, and the old
  // diagonal replaces the new one (names as in flip()).
  for (auto last = flips_.rbegin(); last != flips_.rend(); ++last) {
    const Index h0 = last->here, h1 = next(h0), h2 = previous(h0);
    const Index o0 = last->there, o1 = next(o0), o2 = previous(o0);
    const Complex turn = rotation_between(vector_of(vectors, h0), vector_of(vectors, o0));
    const Complex c_to_a = vector_of(vectors, h1), a_to_d = vector_of(vectors, h2);
    const Complex d_to_b = turn * vector_of(vectors, o1), b_to_c = turn * vector_of(vectors, o2);
    set_vector(vectors, h1, b_to_c);
    set_vector(vectors, h2, c_to_a);
    set_vector(vectors, o1, a_to_d);
    set_vector(vectors, o2, d_to_b);
    set_vector(vectors, h0, -(b_to_c + c_to_a));
    set_vector(vectors, o0, -(a_to_d + d_to_b));
  }
  return vectors;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
