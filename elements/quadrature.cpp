#include "majorant/elements/quadrature.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace majorant {
namespace {

// A simplex inside the reference one: barycentric coordinates of its corners, one per row.
using Piece = RowMatrix;
using Point = Eigen::RowVectorXd;

struct RuleBuilder {
  std::vector<Point> points;
  std::vector<double> weights;

  void add(const Point& p, double w) {
    points.push_back(p);
    weights.push_back(w);
  }
  void add(const Quadrature& rule, const Piece& piece, double measure) {
    for (Index l = 0; l < rule.size(); ++l) {
      Point p = rule.points(l, 0) * piece.row(0);
      for (Index c = 1; c < piece.rows(); ++c) p += rule.points(l, c) * piece.row(c);
      add(p, measure * rule.weights[l]);
    }
  }
  Quadrature build() const {
    Quadrature q;
    q.points.resize(static_cast<Index>(points.size()), points.front().size());
    q.weights.resize(static_cast<Index>(points.size()));
    for (std::size_t l = 0; l < points.size(); ++l) {
      q.points.row(static_cast<Index>(l)) = points[l];
      q.weights[static_cast<Index>(l)] = weights[l];
    }
    return q;
  }
};

bool on_square(const Quadrature& rule) { return rule.points.cols() == 2; }
bool on_triangle(const Quadrature& rule) { return rule.points.cols() == 3; }

// The m^2 congruent subtriangles of `t`.
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

// All (a, b, ...) of `count` numbers >= 0 with sum m.
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

// The lattice cuts a tetrahedron into small ones (as it stands, and upside down) and octahedra.
Quadrature composite_tetrahedron_rule(const Quadrature& rule, int m) {
  const auto e = [](int k) -> Point { return Point::Unit(4, k); };
  RuleBuilder builder;
  const auto add = [&](double cells, const Point& a, const Point& b, const Point& c,
                       const Point& d) {
    Piece piece(4, 4);
    piece << a, b, c, d;
    builder.add(rule, piece / m, cells / (double(m) * m * m));
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
  return builder.build();
}

Quadrature composite_square_rule(const Quadrature& rule, int m) {
  RuleBuilder builder;
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < m; ++i)
      for (Index l = 0; l < rule.size(); ++l)
        builder.add((rule.points.row(l) + Eigen::RowVector2d(i, j)) / m,
                    rule.weights[l] / (double(m) * m));
  return builder.build();
}

// Gauss-Legendre points of [0, 1] and weights that add to 1, by Newton's method.
Quadrature gauss_rule(int m) {
  Quadrature q;
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

}  // namespace

Quadrature lattice_rule(int m) {
  RuleBuilder builder;
  const double third = 1.0 / 3.0;
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m - i; ++j)
      builder.add(Eigen::RowVector3d(i + third, j + third, m - 1 - i - j + third) / m,
                  2.0 / (m * (m + 1.0)));
  return builder.build();
}

Quadrature radon_rule() {
  const double root = std::sqrt(15.0);
  RuleBuilder builder;
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
  RuleBuilder builder;
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

Quadrature tensor_gauss_rule(int m) {
  const Quadrature line = gauss_rule(m);
  RuleBuilder builder;
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < m; ++i)
      builder.add(Eigen::RowVector2d(line.points(i, 0), line.points(j, 0)),
                  line.weights[i] * line.weights[j]);
  return builder.build();
}

Quadrature composite_rule(const Quadrature& rule, int m) {
  if (on_square(rule)) return composite_square_rule(rule, m);
  if (on_triangle(rule)) return corner_graded_rule(rule, m, 0);
  return composite_tetrahedron_rule(rule, m);
}

Quadrature corner_graded_rule(const Quadrature& rule, int m, int levels) {
  RuleBuilder builder;
  for (const Piece& t : subdivide(Piece::Identity(3, 3), m))
    add_graded(rule, t, 1.0 / (double(m) * m), levels, builder);
  return builder.build();
}

Quadrature guarded_rule(const Quadrature& rule, int m, double weight) {
  std::vector<Point> guards;
  if (on_square(rule))
    for (int j = 0; j <= m; ++j)
      for (int i = 0; i <= m; ++i) guards.push_back(Eigen::RowVector2d(i, j));
  else
    guards = lattice_points(static_cast<int>(rule.points.cols()), m);
  RuleBuilder builder;
  for (Index l = 0; l < rule.size(); ++l)
    builder.add(rule.points.row(l), (1 - weight) * rule.weights[l]);
  for (const Point& p : guards) builder.add(p / m, weight / static_cast<double>(guards.size()));
  return builder.build();
}

}  // namespace majorant
