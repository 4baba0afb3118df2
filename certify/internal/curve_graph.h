// A polynomial graph between two pieces of curves, for curve_contact.cpp. It separates curves that
// run along each other at a small distance, for which straight lines would need many short pieces.
//
//   const auto below = [](const auto& b, const auto& a) {      // that piece b is below a
//     using namespace curve_piece;
//     const auto graph = graph_between(a, b);
//     return before(heights(b, graph).all, heights(a, graph).all);   // proof
//   };
//
// (x, height), with x along the pieces and height = y - g(x), are coordinates of the whole plane,
// so that any g gives valid proofs. A good g has height +c on one curve and -c on the other. Pieces
// of length h that are graphs differ from a polynomial of degree 7 by O(h^8). Straight lines need
// sqrt(size / distance) pieces, and this needs about the fourth root of that. The height along a
// curve is a polynomial of degree 7 n, whose Bernstein coefficients enclose it.
#pragma once

#include <Eigen/QR>

#include "majorant/certify/internal/curve_piece.h"

namespace majorant::curve_piece {

// Higher degrees need fewer pairs of pieces: 431, 153, 71, 42, 25 with degrees 3 to 7, for cubics
// at 1e-9 of their length. 7 is the last degree for which the binomials below are exact.
constexpr int kGraphDegree = 7;
// The validity of a graph around the interval where it was fitted, in half widths of that. A
// polynomial fitted on [-1, 1] grows by 2^7 up to there.
constexpr double kGraphReach = 2;

template <class Real>
struct Graph {
  Direction<Real> origin, axis;  // x = axis . (p - origin), y = axis x (p - origin)
  std::array<Real, kGraphDegree + 1> coefficients{};  // of g, by power of x
};

template <class Real>
struct Heights {
  Interval<Real> x, front_x, back_x;  // of the piece and of its ends
  Interval<Real> all, front, back;    // heights of the piece and of its ends
};

namespace detail {

constexpr std::size_t kCompositionSize = PlanarCurve::kMaxDegree * kGraphDegree + 1;

// Returns the table of C(n, k), exact: C(56, 28) < 2^53.
constexpr auto binomial_table() {
  std::array<std::array<double, kCompositionSize>, kCompositionSize> table{};
  for (std::size_t n = 0; n < kCompositionSize; ++n) {
    table[n][0] = 1;
    for (std::size_t k = 1; k <= n; ++k)
      table[n][k] = table[n - 1][k - 1] + (k < n ? table[n - 1][k] : 0);
  }
  return table;
}
inline constexpr auto kBinomials = binomial_table();

inline double binomial(int n, int k) { return kBinomials[n][k]; }

// Bernstein coefficients times their binomials, for which products are convolutions.
template <class Real>
using Scaled = std::array<Real, kCompositionSize>;

template <class Real, class Factor>
void multiply(Scaled<Real>& product, int& degree, const Factor& factor, int factor_degree) {
  Scaled<Real> result{};
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; j <= factor_degree; ++j) result[i + j] += product[i] * factor(j);
  degree += factor_degree;
  product = result;
}

// A piece in the graph's coordinates, each of which is off by at most `error`.
template <class Real>
struct LocalPiece {
  int degree;
  std::array<Real, PlanarCurve::kMaxDegree + 1> x{}, y{};
  Real error = 0;

  LocalPiece(const Piece<Real>& p, const Graph<Real>& graph) : degree(p.degree) {
    const Real length = magnitude(graph.axis.x) + magnitude(graph.axis.y);
    for (int k = 0; k <= degree; ++k) {
      const std::size_t i = to_size(k);
      const Real dx = p.x[i] - graph.origin.x, dy = p.y[i] - graph.origin.y;
      x[i] = graph.axis.x * dx + graph.axis.y * dy;
      y[i] = graph.axis.x * dy - graph.axis.y * dx;
      // Three roundings, of the difference, the product and the sum, each of at most length * size.
      const Real size = std::max(magnitude(dx), magnitude(dy));
      const Real bound = length * (p.error[i] + 5 * Piece<Real>::kUnit * size);
      error = std::max(error, Real(1.01) * bound + kUnderflow);
    }
  }
};

template <class Real>
Interval<Real> widened(Real low, Real high, Real by) {
  return {low - by, high + by};
}

constexpr int kSamples = kGraphDegree + 2;  // of each curve
using SampleMatrix = Eigen::Matrix<double, 2 * kSamples, kGraphDegree + 2>;
using SampleVector = Eigen::Matrix<double, 2 * kSamples, 1>;

// Returns points of a piece in the graph's coordinates, at equally spaced parameters, ends
// included.
template <class Real>
std::array<Direction<Real>, kSamples> sample(const LocalPiece<Real>& p) {
  std::array<Direction<Real>, kSamples> points;
  for (int k = 0; k < kSamples; ++k) {
    const double t = static_cast<double>(k) / (kSamples - 1);
    auto x = p.x, y = p.y;
    for (int level = p.degree; level > 0; --level)
      for (std::size_t i = 0; i < to_size(level); ++i) {
        x[i] += Real(t) * (x[i + 1] - x[i]);
        y[i] += Real(t) * (y[i + 1] - y[i]);
      }
    points[k] = {x[0], y[0]};
  }
  return points;
}

template <class Real>
Real value(const std::array<Real, kGraphDegree + 1>& g, const Real& x) {
  Real sum = g[kGraphDegree];
  for (std::size_t k = kGraphDegree; k-- > 0;) sum = sum * x + g[k];
  return sum;
}

}  // namespace detail

// Makes coordinates along the sum of the chords (or their difference, so that they point the same
// way), with x in [-1, 1] on both pieces, and g = 0.
template <class Real>
Graph<Real> frame_along(const Piece<Real>& a, const Piece<Real>& b) {
  Graph<Real> graph;
  const Direction<Real> u = a.chord(), v = b.chord();
  const Real sense = u.x * v.x + u.y * v.y < 0 ? -1 : 1;
  const double dx = static_cast<double>(u.x + sense * v.x);
  const double dy = static_cast<double>(u.y + sense * v.y), length = std::hypot(dx, dy);
  graph.axis = {Real(dx / length), Real(dy / length)};
  graph.origin = {a.x[0], a.y[0]};
  const auto extent = [&](const Piece<Real>& p) {
    const detail::LocalPiece<Real> local(p, graph);
    const auto [low, high] = std::minmax_element(local.x.begin(), local.x.begin() + p.degree + 1);
    return Interval<Real>{*low, *high};
  };
  const Interval<Real> of_a = extent(a), of_b = extent(b);
  const double low = static_cast<double>(std::min(of_a.low, of_b.low));
  const double high = static_cast<double>(std::max(of_a.high, of_b.high));
  const double middle = (low + high) / 2, half = (high - low) / 2;
  graph.origin.x += graph.axis.x * Real(middle);
  graph.origin.y += graph.axis.y * Real(middle);
  graph.axis = {graph.axis.x / Real(half), graph.axis.y / Real(half)};
  return graph;
}

// Fits y = g(x) + c on a and g(x) - c on b in least squares. The result follows the common shape of
// both.
template <class Real>
Graph<Real> graph_between(const Piece<Real>& a, const Piece<Real>& b) {
  using namespace detail;
  Graph<Real> graph = frame_along(a, b);
  const std::array points{sample(LocalPiece<Real>(a, graph)), sample(LocalPiece<Real>(b, graph))};
  const auto point = [&](int row) { return points[row / kSamples][row % kSamples]; };
  SampleMatrix matrix;
  for (int row = 0; row < 2 * kSamples; ++row) {
    const double x = static_cast<double>(point(row).x);
    for (int k = 0; k <= kGraphDegree; ++k) matrix(row, k) = k == 0 ? 1 : x * matrix(row, k - 1);
    matrix(row, kGraphDegree + 1) = row < kSamples ? 1 : -1;
  }
  const Eigen::HouseholderQR<SampleMatrix> qr(matrix);
  // Rounds of refinement. Each adds the digits of a double; three times 53 bits cover the 113 of a
  // quadruple.
  constexpr int kRounds = Piece<Real>::kUnit < Real(kUnitRoundoff<double>) ? 3 : 1;
  for (int round = 0; round < kRounds; ++round) {
    SampleVector rest;
    for (int row = 0; row < 2 * kSamples; ++row)
      rest(row) = static_cast<double>(point(row).y - value(graph.coefficients, point(row).x));
    const auto fitted = qr.solve(rest).eval();
    for (int k = 0; k <= kGraphDegree; ++k) graph.coefficients[k] += Real(fitted(k));
  }
  return graph;
}

// Returns the rounded Bernstein coefficients of y - g(x) on a piece, of degree kGraphDegree * n.
template <class Real>
detail::Scaled<Real> height_coefficients(const detail::LocalPiece<Real>& p,
                                         const Graph<Real>& graph) {
  using namespace detail;
  const int n = p.degree, all = n * kGraphDegree;
  Scaled<Real> composed{graph.coefficients[kGraphDegree]};
  int degree = 0;
  for (int j = kGraphDegree - 1; j >= 0; --j) {
    multiply(
        composed, degree, [&](int k) { return Real(binomial(n, k)) * p.x[k]; }, n);
    for (int k = 0; k <= degree; ++k)
      composed[k] += graph.coefficients[j] * Real(binomial(degree, k));
  }
  Scaled<Real> heights{};
  for (int k = 0; k <= n; ++k) heights[k] = Real(binomial(n, k)) * p.y[k];
  degree = n;
  multiply(
      heights, degree, [&](int k) { return Real(binomial(all - n, k)); }, all - n);
  for (int k = 0; k <= all; ++k) heights[k] = (heights[k] - composed[k]) / Real(binomial(all, k));
  return heights;
}

// The error of a coefficient is that of the inputs times the largest slope of g, plus all roundings
// of a term and its sum, times the sum of absolute values. Heights are infinite if the piece
// reaches too far or numbers are out of range.
template <class Real>
Heights<Real> heights(const Piece<Real>& p, const Graph<Real>& graph) {
  using namespace detail;
  constexpr Real kInfinity = std::numeric_limits<double>::infinity();
  constexpr Interval<Real> kAnywhere{-kInfinity, kInfinity};
  const LocalPiece<Real> local(p, graph);
  const int n = p.degree;
  Real reach = 0, above = 0;
  for (int k = 0; k <= n; ++k) {
    reach = std::max(reach, magnitude(local.x[k]));
    above = std::max(above, magnitude(local.y[k]));
  }
  reach += local.error;
  Real sum = 0, slope = 0;  // bounds of |g| and |g'| at `reach`
  for (std::size_t k = kGraphDegree + 1; k-- > 0;) {
    slope = slope * reach + sum;
    sum = sum * reach + magnitude(graph.coefficients[k]);
  }
  const int roundings = kGraphDegree * (n + 4) + n + 6;
  const Real error =
      Real(1.01) * (local.error * (1 + slope) + roundings * Piece<Real>::kUnit * (sum + above)) +
      Real(std::numeric_limits<double>::min());
  // NaN compares false. If the axis is finite, so are the coordinates. The limit, times a
  // coordinate below PlanarCurve's limit, stays within the range of doubles.
  constexpr double kLargestAxis = 1e150;
  const Real axis = magnitude(graph.axis.x) + magnitude(graph.axis.y);
  if (!(axis <= kLargestAxis && reach <= kGraphReach && above <= kGraphReach &&
        error <= kGraphReach))
    return {kAnywhere, kAnywhere, kAnywhere, kAnywhere, kAnywhere, kAnywhere};

  Heights<Real> result;
  const auto [low_x, high_x] = std::minmax_element(local.x.begin(), local.x.begin() + n + 1);
  result.x = widened(*low_x, *high_x, local.error);
  result.front_x = widened(local.x[0], local.x[0], local.error);
  result.back_x = widened(local.x[n], local.x[n], local.error);
  const Scaled<Real> y = height_coefficients(local, graph);
  const std::size_t last = to_size(n * kGraphDegree);
  const auto [low, high] = std::minmax_element(y.begin(), y.begin() + last + 1);
  result.all = widened(*low, *high, error);
  result.front = widened(y[0], y[0], error);
  result.back = widened(y[last], y[last], error);
  return result;
}

}  // namespace majorant::curve_piece

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
