#include "majorant/certify/loop_winding.h"

#include <algorithm>
#include <limits>

#include "majorant/certify/internal/curve_piece.h"
#include "majorant/mesh/exact_predicates.h"

namespace majorant {
namespace {

using curve_piece::along;
using curve_piece::Direction;
using curve_piece::Piece;

// ---- Sense ----

// Returns the sense of the polygon of the vertices, if it is simple: the turn at its
// lexicographically first vertex.
int sense_of_polygon(const BoundaryLoops& boundary, const BoundaryLoop& loop) {
  const auto first = boundary.curves.begin() + loop.first,
             last = boundary.curves.begin() + loop.last;
  const auto lowest = std::min_element(first, last, [](const auto& a, const auto& b) {
    const Vector2 &p = a.front(), &q = b.front();
    return p.x() < q.x() || (p.x() == q.x() && p.y() < q.y());
  });
  const PlanarCurve& before = lowest == first ? *(last - 1) : *(lowest - 1);
  return orientation(before.front(), lowest->front(), lowest->back());
}

template <class Real>
Real binomial(int n, int k) {
  Real value = 1;
  for (int i = 1; i <= k; ++i) value = value * (n - k + i) / i;
  return value;
}

// Returns the sign of the enclosed area, 0 if the error bound hides it. Twice the area is the
// integral of c x c' dt. In Bernstein coefficients this is a sum of c_i x (c_{j+1} - c_j) with
// weights C(n,i) C(n-1,j) / (2 C(2n-1,i+j)).
template <class Real>
int sign_of_area(const BoundaryLoops& boundary, const BoundaryLoop& loop) {
  const Vector2 origin = boundary.curves[loop.first].front();
  const auto difference = [](const Vector2& a, const Vector2& b) {
    return Direction<Real>{Real(a.x()) - Real(b.x()), Real(a.y()) - Real(b.y())};
  };
  Real sum = 0, size = 0;
  for (Index k = loop.first; k < loop.last; ++k) {
    const PlanarCurve& curve = boundary.curves[k];
    const int n = curve.degree;
    Real of_curve = 0;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j < n; ++j) {
        const auto point = [&](int l) { return curve.control_points[l]; };
        const Direction<Real> c = difference(point(i), origin),
                              d = difference(point(j + 1), point(j));
        const Real weight = binomial<Real>(n, i) * binomial<Real>(n - 1, j) /
                            (2 * binomial<Real>(2 * n - 1, i + j));
        of_curve += weight * (c.x * d.y - c.y * d.x);
        size += weight * (magnitude(c.x * d.y) + magnitude(c.y * d.x));
      }
    sum += of_curve;
  }
  // Roundings of a term (10), of the sum over a curve (at most 72), and over the curves.
  const Real bound = Real(1.01) * Piece<Real>::kUnit * Real(100.0 + loop.last - loop.first) * size +
                     Real(std::numeric_limits<double>::min());
  return sum > bound ? 1 : sum < -bound ? -1 : 0;
}

// ---- Winding numbers ----

// Returns the crossings of the ray by an edge from a to b, upwards minus downwards; none if the
// edge contains p.
std::optional<int> crossings_of_line(const Vector2& a, const Vector2& b, const Vector2& p) {
  if (on_segment(a, b, p)) return {};
  const int up = (b.y() > p.y()) - (a.y() > p.y());
  return orientation(a, b, p) == up ? up : 0;
}

// Counts crossings relative to p. A piece in a half-plane without p can be pulled straight there,
// and the half-plane contains a part of the ray or of its opposite, not of both. Rounded ends lie
// within the enclosures along the axes, so rounding acts as a detour there and back.
std::optional<int> crossings_of_piece(const Piece<double>& piece) {
  const auto chord = piece.chord();
  for (const Direction<double>& axis : {Direction<double>{1, 0}, {0, 1}, {-chord.y, chord.x}}) {
    const auto range = along(piece, axis);
    if (!(range.low > 0 || range.high < 0)) continue;
    const bool contains_ray = range.low > 0 ? axis.x > 0 : axis.x < 0;
    return contains_ray ? (piece.y[piece.degree] > 0) - (piece.y[0] > 0) : 0;
  }
  if (piece.depth >= Piece<double>::kDeepest || !(piece.size() > 4 * piece.largest_error()))
    return {};
  const auto [first, second] = split(piece);
  const auto one = crossings_of_piece(first);
  if (!one) return {};
  const auto two = crossings_of_piece(second);
  return two ? std::optional(*one + *two) : std::nullopt;
}

std::vector<Box2> boxes_of(const std::vector<PlanarCurve>& curves) {
  std::vector<Box2> boxes;
  for (const PlanarCurve& curve : curves) boxes.push_back(box_of(curve));
  return boxes;
}

}  // namespace

Box2 box_of(const PlanarCurve& curve) {
  Box2 box{curve.front(), curve.front()};
  for (int k = 1; k <= curve.degree; ++k) {
    box.low = box.low.cwiseMin(curve.control_points[k]);
    box.high = box.high.cwiseMax(curve.control_points[k]);
  }
  return box;
}

int sense_of(const BoundaryLoops& boundary, const BoundaryLoop& loop) {
  const bool straight =
      std::all_of(boundary.curves.begin() + loop.first, boundary.curves.begin() + loop.last,
                  [](const PlanarCurve& c) { return c.degree == 1; });
  if (straight) return sense_of_polygon(boundary, loop);
  const int sign = sign_of_area<double>(boundary, loop);
  return sign != 0 ? sign : sign_of_area<Float128>(boundary, loop);
}

LoopWinding::LoopWinding(const BoundaryLoops& boundary)
    : boundary_(boundary), tree_(boxes_of(boundary.curves)) {
  for (std::size_t k = 0; k < boundary.loops.size(); ++k)
    loop_of_.insert(loop_of_.end(), to_size(boundary.loops[k].last - boundary.loops[k].first), k);
}

std::optional<long> LoopWinding::around(const Vector2& p, const Choice& chosen) const {
  std::optional<long> turns = 0;
  const Vector2 end_of_ray(std::numeric_limits<double>::infinity(), p.y());
  tree_.visit_meeting({p, end_of_ray}, [&](Index k) {
    if (!turns || !chosen(boundary_.loops[loop_of_[k]])) return;
    const PlanarCurve& curve = boundary_.curves[k];
    const std::optional<int> crossings = curve.degree == 1
                                             ? crossings_of_line(curve.front(), curve.back(), p)
                                             : crossings_of_piece({curve, p});
    turns = crossings ? std::optional(*turns + *crossings) : std::nullopt;
  });
  return turns;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
