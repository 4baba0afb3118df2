#include "majorant/certify/exact_positivity.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <vector>

#include "majorant/elements/bernstein.h"
#include "majorant/elements/bernstein_space.h"
#include "majorant/elements/det_coefficients.h"
#include "majorant/framework/error.h"
#include "majorant/mesh/exact_integers.h"

namespace majorant {
namespace {

using Integer = boost::multiprecision::cpp_int;

// Pieces of one cell. Valid cells whose minimum is 1e-9 of their mean take some hundred; without a
// bound a minimum of exactly zero at an irrational point would be bisected for ever. Origin: ten
// times what valid cells take.
constexpr int kMostPieces = 4000;
// The depth of bisection; two halve the edges, so pieces are 2^-50 of the cell then. Integers grow
// with it. Coordinates in doubles say nothing below.
constexpr int kDeepest = 100;

// A triangular array of Bernstein coefficients of degree `degree`, and the corners of the piece.
struct DeterminantPiece {
  int degree;
  std::vector<Integer> c;
  std::array<Barycentric, 3> corners;
  int depth = 0;

  // i + j + k = degree; rows of constant k.
  std::size_t at(int j, int k) const {
    return majorant::to_size(k * (degree + 1) - k * (k - 1) / 2 + j);
  }
};

const DetCoefficients& det_of_degree(int degree) {
  static const std::vector<DetCoefficients> kAll = [] {
    std::vector<DetCoefficients> all;
    Cells face(1, 3);
    face << 0, 1, 2;
    for (int n = 1; n <= BezierTriangleSpace::kMaxDegree; ++n)
      all.emplace_back(BezierTriangleSpace(face, 3, n).element());
    return all;
  }();
  return kAll[degree - 1];
}

DeterminantPiece determinant(const Points2& control_points) {
  const int n = degree_from_control_points(static_cast<int>(control_points.rows()));
  const DetCoefficients& det = det_of_degree(n);
  const std::vector<Integer> scaled =
      det.scaled(to_integers<Integer>(control_points.reshaped<Eigen::RowMajor>()));
  DeterminantPiece piece{
      2 * (n - 1), {}, {Barycentric::UnitX(), Barycentric::UnitY(), Barycentric::UnitZ()}, 0};
  piece.c.resize(scaled.size());
  for (int t = 0; t < det.count(); ++t) {
    const Exponents& e = det.basis().exponents(t);
    piece.c[piece.at(e[1], e[2])] = scaled[t];
  }
  return piece;
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
      // On (old corner 0, middle, old 2) the coefficient has exponents (d - r, r, k); by (middle,
      // old 1, old 2) it has (r, d - r, k).
      half[0].c[half[0].at(d - r, r)] = row.front() << scale;
      half[1].c[half[1].at(k, r)] = row[d - r] << scale;
      for (int j = 0; j + r < d; ++j) row[j] += row[j + 1];
    }
  }
  return half;
}

}  // namespace

CellPositivity exact_positivity(const Points2& control_points, const StopCheck& stop) {
  const int degree = degree_from_control_points(static_cast<int>(control_points.rows()));
  if (degree < 1 || degree > BezierTriangleSpace::kMaxDegree)
    throw InvalidArgument(
        fmt::format("exact_positivity: {} control points; a triangle of degree 1 "
                    "to {} is needed",
                    control_points.rows(), BezierTriangleSpace::kMaxDegree));
  if (!control_points.allFinite()) return {};
  std::vector<DeterminantPiece> open{determinant(control_points)};
  bool is_left = false;
  for (int pieces = 0; !open.empty(); ++pieces) {
    stop.poll();
    if (pieces == kMostPieces) return {};
    const DeterminantPiece piece = std::move(open.back());
    open.pop_back();
    const std::array<std::size_t, 3> corners = {piece.at(0, 0), piece.at(piece.degree, 0),
                                                piece.at(0, piece.degree)};
    for (std::size_t k = 0; k < 3; ++k)
      if (piece.c[corners[k]] <= 0) return {ProofStatus::Violated, piece.corners[k]};
    if (std::all_of(piece.c.begin(), piece.c.end(), [](const Integer& c) { return c > 0; }))
      continue;
    is_left = is_left || piece.depth == kDeepest;
    if (piece.depth == kDeepest) continue;
    for (DeterminantPiece& half : halves(piece)) open.push_back(std::move(half));
  }
  if (is_left) return {};
  return {ProofStatus::Proven, Barycentric::Zero()};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
