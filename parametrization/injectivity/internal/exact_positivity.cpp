#include "majorant/parametrization/injectivity/internal/exact_positivity.h"

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "majorant/framework/error.h"

namespace majorant {
namespace {

using Integer = boost::multiprecision::cpp_int;

// Pieces of one cell. Valid cells whose minimum is 1e-9 of their mean take some hundred; without a
// bound a minimum of exactly zero at an irrational point would be bisected for ever. Origin: ten
// times what valid cells take.
constexpr int kMostPieces = 4000;
// Of bisection; two halve the edges, so pieces are 2^-50 of the cell then. Integers grow with it.
// Origin: coordinates in doubles say nothing below.
constexpr int kDeepest = 100;
constexpr int kMantissaBits = std::numeric_limits<double>::digits;

struct IntegerPoint {
  Integer u, v;
};

Integer cross(const IntegerPoint& a, const IntegerPoint& b) { return a.u * b.v - a.v * b.u; }

IntegerPoint operator-(const IntegerPoint& a, const IntegerPoint& b) {
  return {a.u - b.u, a.v - b.v};
}

// value = mantissa * 2^exponent, exactly.
struct Dyadic {
  std::int64_t mantissa;
  int exponent;
  explicit Dyadic(double value) {
    const double fraction = std::frexp(value, &exponent);
    mantissa = static_cast<std::int64_t>(std::ldexp(fraction, kMantissaBits));
    exponent -= kMantissaBits;
  }
};

// All coordinates over one power of two, which leaves signs as they are.
std::vector<IntegerPoint> to_integers(const Points2& points) {
  int lowest = std::numeric_limits<int>::max();
  for (const double value : points.reshaped())
    if (value != 0) lowest = std::min(lowest, Dyadic(value).exponent);
  const auto scaled = [&](double value) {
    if (value == 0) return Integer(0);
    const Dyadic d(value);
    return Integer(d.mantissa) << static_cast<unsigned>(d.exponent - lowest);
  };
  std::vector<IntegerPoint> out;
  for (Index p = 0; p < points.rows(); ++p)
    out.push_back({scaled(points(p, 0)), scaled(points(p, 1))});
  return out;
}

Integer factorial(int n) {
  Integer value = 1;
  for (int k = 2; k <= n; ++k) value *= k;
  return value;
}

// A triangular array of Bernstein coefficients of degree `degree`, and the corners of the piece.
struct DeterminantPiece {
  int degree;
  std::vector<Integer> c;
  std::array<Barycentric, 3> corners;
  int depth = 0;

  // i + j + k = degree; rows of constant k.
  std::size_t at(int j, int k) const {
    return majorant::at(k * (degree + 1) - k * (k - 1) / 2 + j);
  }
};

// (2m)! det J for degree n = m + 1: the coefficient of xi^I is
//   i! j! k! sum_{alpha + beta = I} C(alpha) C(beta) d_1 b_alpha x d_2 b_beta,
// C the multinomial coefficients of degree m, d_r b_alpha = b_{alpha + e_r} - b_{alpha + e_0}.
DeterminantPiece determinant(const TriangleIndices& ix, const std::vector<IntegerPoint>& b) {
  const int m = ix.degree() - 1;
  DeterminantPiece det{
      2 * m, {}, {Barycentric::UnitX(), Barycentric::UnitY(), Barycentric::UnitZ()}, 0};
  det.c.resize(at(control_point_count(2 * m)));
  const TriangleIndices& lower = TriangleIndices::of_degree(m);
  const auto point = [&](int i, int j, int k) -> const IntegerPoint& {
    return b[at(ix.local(i, j, k))];
  };
  std::vector<IntegerPoint> along_1, along_2;
  for (int l = 0; l < lower.count(); ++l) {
    const auto [i, j, k] = lower.multi(l);
    along_1.push_back(point(i, j + 1, k) - point(i + 1, j, k));
    along_2.push_back(point(i, j, k + 1) - point(i + 1, j, k));
  }
  for (int s = 0; s < lower.count(); ++s)
    for (int t = 0; t < lower.count(); ++t) {
      const MultiIndex &a = lower.multi(s), &d = lower.multi(t);
      const auto weight =
          static_cast<std::int64_t>(lower.multinomial(s)) * Integer(lower.multinomial(t));
      det.c[det.at(a[1] + d[1], a[2] + d[2])] += weight * cross(along_1[at(s)], along_2[at(t)]);
    }
  for (int k = 0; k <= 2 * m; ++k)
    for (int j = 0; j + k <= 2 * m; ++j)
      det.c[det.at(j, k)] *= factorial(2 * m - j - k) * factorial(j) * factorial(k);
  return det;
}

// Both halves across the edge from corner 0 to 1, all coefficients times 2^degree. Corners are
// renamed so that every edge has its turn: 0, 1, 2 become 2, 0, middle and 1, 2, middle.
std::array<DeterminantPiece, 2> halves(const DeterminantPiece& p) {
  const int n = p.degree;
  const Barycentric middle = (p.corners[0] + p.corners[1]) / 2;
  std::array<DeterminantPiece, 2> half{
      DeterminantPiece{n, p.c, {p.corners[2], p.corners[0], middle}, p.depth + 1},
      DeterminantPiece{n, p.c, {p.corners[1], p.corners[2], middle}, p.depth + 1}};
  for (int k = 0; k <= n; ++k) {
    const int d = n - k;  // the row is a polynomial of degree d along the edge
    std::vector<Integer> row;
    for (int j = 0; j <= d; ++j) row.push_back(p.c[p.at(j, k)]);
    for (int r = 0; r <= d; ++r) {
      const auto scale = static_cast<unsigned>(n - r);
      // By (old corner 0, middle, old 2) the coefficient has exponents (d - r, r, k); by (middle,
      // old 1, old 2) it has (r, d - r, k).
      half[0].c[half[0].at(d - r, r)] = row.front() << scale;
      half[1].c[half[1].at(k, r)] = row[at(d - r)] << scale;
      for (int j = 0; j + r < d; ++j) row[at(j)] += row[at(j) + 1];
    }
  }
  return half;
}

}  // namespace

ExactPositivity exact_positivity(const Points2& control_points, const StopCheck& stop) {
  const int degree = degree_from_control_points(static_cast<int>(control_points.rows()));
  if (degree < 1 || degree > TriangleIndices::kMaxDegree)
    throw InvalidArgument("exact_positivity: no Bezier triangle of degree 1..20");
  std::vector<DeterminantPiece> open{
      determinant(TriangleIndices::of_degree(degree), to_integers(control_points))};
  bool is_left = false;
  for (int pieces = 0; !open.empty(); ++pieces) {
    stop.poll();
    if (pieces == kMostPieces) return {};
    const DeterminantPiece piece = std::move(open.back());
    open.pop_back();
    const std::array<std::size_t, 3> corners = {piece.at(0, 0), piece.at(piece.degree, 0),
                                                piece.at(0, piece.degree)};
    for (std::size_t k = 0; k < 3; ++k)
      if (piece.c[corners[k]] <= 0) return {Positivity::Violated, piece.corners[k]};
    if (std::all_of(piece.c.begin(), piece.c.end(), [](const Integer& c) { return c > 0; }))
      continue;
    is_left = is_left || piece.depth == kDeepest;
    if (piece.depth == kDeepest) continue;
    for (DeterminantPiece& half : halves(piece)) open.push_back(std::move(half));
  }
  if (is_left) return {};
  return {Positivity::Certified, Barycentric::Zero()};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
