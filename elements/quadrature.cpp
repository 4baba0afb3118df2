#include "majorant/elements/quadrature.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"

namespace majorant {
namespace {

// The tolerance of checks, above the rounding of rules that are printed with 15 digits or more
// (1e-15). Chosen, not tuned.
constexpr double kRuleTolerance = 1e-12;

using Point = Eigen::RowVectorXd;
// A cell inside the reference one. Row k holds the homogeneous coordinates of the point at which
// its own homogeneous coordinate k is 1; for a simplex these are its corners.
using Piece = RowMatrix;

Index column_count(const Factors& cell) {
  Index columns = 0;
  for (const int corners : cell) columns += corners == 2 ? 1 : corners;
  return columns;
}

// Computes homogeneous coordinates of a row of Quadrature::points; a segment gets 1-t and t.
void to_homogeneous(const Factors& cell, Eigen::Ref<const Point> point, Point& out) {
  out.resize(std::accumulate(cell.begin(), cell.end(), 0));
  Index from = 0, to = 0;
  for (const int corners : cell) {
    if (corners == 2) out[to++] = 1 - point[from];
    for (const Index end = from + (corners == 2 ? 1 : corners); from < end;)
      out[to++] = point[from++];
  }
}

class RuleBuilder {
 public:
  explicit RuleBuilder(Factors cell) : cell_(std::move(cell)) {}

  void add(const Point& homogeneous, double weight) {
    Index from = 0;
    for (const int corners : cell_) {
      if (corners == 2) ++from;
      for (const Index end = from + (corners == 2 ? 1 : corners); from < end;)
        coordinates_.push_back(homogeneous[from++]);
    }
    weights_.push_back(weight);
  }
  void add(const Quadrature& rule, const Piece& piece, double measure) {
    Point x, p;
    for (Index l = 0; l < rule.size(); ++l) {
      to_homogeneous(cell_, rule.points.row(l), x);
      p = x[0] * piece.row(0);
      for (Index c = 1; c < piece.rows(); ++c) p += x[c] * piece.row(c);
      add(p, measure * rule.weights[l]);
    }
  }
  Quadrature build() const {
    Quadrature q;
    q.cell = cell_;
    const auto size = static_cast<Index>(weights_.size());
    q.points = Eigen::Map<const RowMatrix>(coordinates_.data(), size, column_count(cell_));
    q.weights = Eigen::Map<const Vec>(weights_.data(), size);
    return q;
  }

 private:
  Factors cell_;
  std::vector<double> coordinates_, weights_;  // point by point
};

void require_composable(const Quadrature& rule, std::string_view name) {
  for (const int corners : rule.cell)
    if (corners < 2 || corners > 4)
      throw InvalidArgument(
          fmt::format("{}: cells are products of segments, triangles and "
                      "tetrahedra, not of simplices with {} corners",
                      name, corners));
  require_cell(rule, rule.cell, name);
}

// Returns the m^2 congruent subtriangles of `t`.
std::vector<Piece> subdivide(const Piece& t, int m) {
  const auto at = [&](int i, int j) -> Point {
    return (double(i) * t.row(0) + double(j) * t.row(1) + double(m - i - j) * t.row(2)) / double(m);
  };
  std::vector<Piece> out;
  const auto push = [&](const Point& a, const Point& b, const Point& c) {
    out.emplace_back(3, 3) << a, b, c;
  };
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m - i; ++j) {
      push(at(i + 1, j), at(i, j + 1), at(i, j));
      if (i + j < m - 1) push(at(i, j + 1), at(i + 1, j), at(i + 1, j + 1));
    }
  return out;
}

bool touches_corner(const Piece& t) { return t.maxCoeff() == 1.0; }

void add_graded(const Quadrature& rule, const Piece& t, double area, int levels,
                RuleBuilder& builder) {
  if (levels == 0 || !touches_corner(t)) return builder.add(rule, t, area);
  for (const Piece& child : subdivide(t, 2)) add_graded(rule, child, area / 4, levels - 1, builder);
}

// Returns all (a, b, ...) of `count` numbers >= 0 with sum m.
std::vector<Point> lattice_points(int count, int m) {
  if (count == 1) return {Point::Constant(1, m)};
  std::vector<Point> out;
  for (int a = 0; a <= m; ++a)
    for (const Point& rest : lattice_points(count - 1, m - a)) {
      out.emplace_back(count);
      out.back() << a, rest;
    }
  return out;
}

// Returns all points of the cell whose homogeneous coordinates are multiples of 1/m, times m.
std::vector<Point> lattice_points(const Factors& cell, int m) {
  std::vector<Point> out{Point(0)};
  for (const int corners : cell) {
    std::vector<Point> longer;
    for (const Point& head : out)
      for (const Point& tail : lattice_points(corners, m)) {
        longer.emplace_back(head.size() + tail.size());
        longer.back() << head, tail;
      }
    out = longer;
  }
  return out;
}

struct WeightedPiece {
  Piece piece;
  double share;  // fraction of the measure of the cell
};

std::vector<WeightedPiece> segment_pieces(int m) {
  std::vector<WeightedPiece> out;
  for (int k = 0; k < m; ++k) {
    out.push_back({Piece(2, 2), 1.0 / m});
    out.back().piece << m - k, k, m - k - 1, k + 1;
    out.back().piece /= m;
  }
  return out;
}

std::vector<WeightedPiece> triangle_pieces(int m) {
  std::vector<WeightedPiece> out;
  for (const Piece& t : subdivide(Piece::Identity(3, 3), m))
    out.push_back({t, 1.0 / (double(m) * m)});
  return out;
}

// Returns the pieces of a tetrahedron: the lattice cuts it into small ones (upright and upside
// down) and octahedra.
std::vector<WeightedPiece> tetrahedron_pieces(int m) {
  const auto e = [](int k) -> Point { return Point::Unit(4, k); };
  std::vector<WeightedPiece> out;
  const auto add = [&](double cells, const Point& a, const Point& b, const Point& c,
                       const Point& d) {
    Piece piece(4, 4);
    piece << a, b, c, d;
    out.push_back({piece / m, cells / (double(m) * m * m)});
  };
  for (const Point& p : lattice_points(4, m - 1)) add(1, p + e(0), p + e(1), p + e(2), p + e(3));
  const Point one = Point::Ones(4);
  if (m >= 3)
    for (const Point& q : lattice_points(4, m - 3)) {
      const Point p = q + one;
      add(1, p - e(0), p - e(1), p - e(2), p - e(3));
    }
  if (m >= 2)
    for (const Point& p : lattice_points(4, m - 2))
      for (int a = 0; a < 4; ++a) {  // the octahedron's faces: edges at a, edges opposite to a
        const int b = (a + 1) % 4, c = (a + 2) % 4, d = (a + 3) % 4;
        const Point centre = p + one / 2;
        add(0.5, centre, p + e(a) + e(b), p + e(a) + e(c), p + e(a) + e(d));
        add(0.5, centre, p + e(b) + e(c), p + e(c) + e(d), p + e(d) + e(b));
      }
  return out;
}

std::vector<WeightedPiece> simplex_pieces(int corners, int m) {
  return corners == 2   ? segment_pieces(m)
         : corners == 3 ? triangle_pieces(m)
                        : tetrahedron_pieces(m);
}

// Returns the products of the pieces of the factors.
std::vector<WeightedPiece> pieces_of(const Factors& cell, int m) {
  std::vector<WeightedPiece> out{{Piece(0, 0), 1}};
  for (const int corners : cell) {
    std::vector<WeightedPiece> larger;
    for (const WeightedPiece& a : out)
      for (const WeightedPiece& b : simplex_pieces(corners, m)) {
        const Index size = a.piece.rows(), all = size + corners;
        larger.push_back({Piece::Zero(all, all), a.share * b.share});
        larger.back().piece.topLeftCorner(size, size) = a.piece;
        larger.back().piece.bottomRightCorner(corners, corners) = b.piece;
      }
    out = larger;
  }
  return out;
}

}  // namespace

void require_cell(const Quadrature& rule, const Factors& cell, std::string_view name) {
  const auto refuse = [&](const std::string& what) {
    throw InvalidArgument(fmt::format("{}: quadrature {}", name, what));
  };
  const auto text = [](const Factors& f) { return fmt::format("{{{}}}", fmt::join(f, ", ")); };
  if (rule.cell != cell)
    refuse(fmt::format("of the cell {}, {} is needed (corners of each factor)", text(rule.cell),
                       text(cell)));
  if (rule.size() == 0 || rule.points.rows() != rule.size() ||
      rule.points.cols() != column_count(cell))
    refuse(fmt::format("with {} weights and {} by {} points, {} columns are needed", rule.size(),
                       rule.points.rows(), rule.points.cols(), column_count(cell)));
  if (!(std::abs(rule.weights.sum() - 1) <= kRuleTolerance * static_cast<double>(rule.size())))
    refuse(fmt::format("whose weights add to {} and not to 1", rule.weights.sum()));
  Point x;
  for (Index l = 0; l < rule.size(); ++l) {
    to_homogeneous(cell, rule.points.row(l), x);
    bool inside = std::isfinite(rule.weights[l]);
    Index from = 0;
    for (const int corners : cell) {
      const auto block = x.segment(from, corners);
      inside = inside && block.minCoeff() >= -kRuleTolerance &&
               std::abs(block.sum() - 1) <= kRuleTolerance;
      from += corners;
    }
    if (!inside) refuse(fmt::format("whose point {} is outside the cell", l));
  }
}

// Returns Gauss-Legendre points, by Newton's method.
Quadrature gauss_rule(int m) {
  require_at_least("gauss_rule: m", m, 1);
  Quadrature q;
  q.cell = {2};
  q.points.resize(m, 1);
  q.weights.resize(m);
  for (int k = 0; k < m; ++k) {
    double x = std::cos(std::numbers::pi * (k + 0.75) / (m + 0.5)), slope = 1;
    for (int step = 0; step < 8; ++step) {
      double p = 1, before = 0;  // Legendre polynomials
      for (int n = 1; n <= m; ++n) {
        const double next = ((2 * n - 1) * x * p - (n - 1) * before) / n;
        before = p;
        p = next;
      }
      slope = m * (x * p - before) / (x * x - 1);
      x -= p / slope;
    }
    q.points(m - 1 - k, 0) = (1 + x) / 2;
    q.weights[m - 1 - k] = 1 / ((1 - x * x) * slope * slope);
  }
  return q;
}

Quadrature lattice_rule(int m) {
  require_at_least("lattice_rule: m", m, 1);
  RuleBuilder builder({3});
  const double third = 1.0 / 3.0;
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m - i; ++j)
      builder.add(Eigen::RowVector3d(i + third, j + third, m - 1 - i - j + third) / m,
                  2.0 / (m * (m + 1.0)));
  return builder.build();
}

Quadrature radon_rule() {
  const double root = std::sqrt(15.0);
  RuleBuilder builder({3});
  builder.add(Point::Constant(3, 1.0 / 3.0), 9.0 / 40.0);
  for (const double sign : {-1.0, 1.0}) {
    const double a = (6 + sign * root) / 21, w = (155 + sign * root) / 1200;
    for (int k = 0; k < 3; ++k) {
      Point p = Point::Constant(3, a);
      p[k] = 1 - 2 * a;
      builder.add(p, w);
    }
  }
  return builder.build();
}

Quadrature walkington_rule() {
  RuleBuilder builder({4});
  const auto add_corners = [&](double a, double w) {
    for (int k = 0; k < 4; ++k) {
      Point p = Point::Constant(4, a);
      p[k] = 1 - 3 * a;
      builder.add(p, w);
    }
  };
  add_corners(0.31088591926330060980, 0.11268792571801585080);
  add_corners(0.092735250310891226402, 0.073493043116361949544);
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < k; ++j) {
      constexpr double a = 0.045503704125649649492;
      Point p = Point::Constant(4, a);
      p[j] = p[k] = 0.5 - a;
      builder.add(p, 0.042546020777081466438);
    }
  return builder.build();
}

Quadrature product_rule(const Quadrature& a, const Quadrature& b) {
  Quadrature q;
  q.cell = a.cell;
  q.cell.insert(q.cell.end(), b.cell.begin(), b.cell.end());
  q.points.resize(a.size() * b.size(), a.points.cols() + b.points.cols());
  q.weights.resize(a.size() * b.size());
  for (Index j = 0, l = 0; j < b.size(); ++j)
    for (Index i = 0; i < a.size(); ++i, ++l) {
      q.points.row(l) << a.points.row(i), b.points.row(j);
      q.weights[l] = a.weights[i] * b.weights[j];
    }
  return q;
}

Quadrature tensor_gauss_rule(int m) { return product_rule(gauss_rule(m), gauss_rule(m)); }

Quadrature composite_rule(const Quadrature& rule, int m) {
  require_composable(rule, "composite_rule");
  require_at_least("composite_rule: m", m, 1);
  RuleBuilder builder(rule.cell);
  for (const WeightedPiece& p : pieces_of(rule.cell, m)) builder.add(rule, p.piece, p.share);
  return builder.build();
}

Quadrature corner_graded_rule(const Quadrature& rule, int m, int levels) {
  require_cell(rule, {3}, "corner_graded_rule");
  require_at_least("corner_graded_rule: m", m, 1);
  require_at_least("corner_graded_rule: levels", levels, 0);
  RuleBuilder builder(rule.cell);
  for (const Piece& t : subdivide(Piece::Identity(3, 3), m))
    add_graded(rule, t, 1.0 / (double(m) * m), levels, builder);
  return builder.build();
}

Quadrature guarded_rule(const Quadrature& rule, int m, double weight) {
  require_composable(rule, "guarded_rule");
  require_at_least("guarded_rule: m", m, 1);
  if (!(weight >= 0 && weight < 1))
    throw InvalidArgument(
        fmt::format("guarded_rule: the weight is {:g}, 0..1 are possible", weight));
  const std::vector<Point> guards = lattice_points(rule.cell, m);
  RuleBuilder builder(rule.cell);
  Point x;
  for (Index l = 0; l < rule.size(); ++l) {
    to_homogeneous(rule.cell, rule.points.row(l), x);
    builder.add(x, (1 - weight) * rule.weights[l]);
  }
  for (const Point& p : guards) builder.add(p / m, weight / static_cast<double>(guards.size()));
  return builder.build();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
