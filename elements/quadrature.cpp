#include "majorant/elements/quadrature.h"

#include <cmath>
#include <vector>

namespace majorant {
namespace {

struct Triangle {
  Barycentric a, b, c;
};

struct RuleBuilder {
  std::vector<Barycentric> points;
  std::vector<double> weights;

  void add(const Barycentric& p, double w) {
    points.push_back(p);
    weights.push_back(w);
  }
  void add(const Quadrature& rule, const Triangle& t, double area) {
    for (Index l = 0; l < rule.size(); ++l)
      add(rule.points(l, 0) * t.a + rule.points(l, 1) * t.b + rule.points(l, 2) * t.c,
          area * rule.weights[l]);
  }
  Quadrature build() const {
    Quadrature q;
    q.points.resize(static_cast<Index>(points.size()), 3);
    q.weights.resize(static_cast<Index>(points.size()));
    for (std::size_t l = 0; l < points.size(); ++l) {
      q.points.row(static_cast<Index>(l)) = points[l];
      q.weights[static_cast<Index>(l)] = weights[l];
    }
    return q;
  }
};

// The m^2 congruent subtriangles of `t`.
std::vector<Triangle> subdivide(const Triangle& t, int m) {
  const auto at = [&](int i, int j) -> Barycentric {
    return (double(i) * t.a + double(j) * t.b + double(m - i - j) * t.c) / double(m);
  };
  std::vector<Triangle> out;
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m - i; ++j) {
      out.push_back({at(i + 1, j), at(i, j + 1), at(i, j)});
      if (i + j < m - 1) out.push_back({at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)});
    }
  return out;
}

Triangle reference() { return {Barycentric::UnitX(), Barycentric::UnitY(), Barycentric::UnitZ()}; }

bool touches_corner(const Triangle& t) {
  return t.a.maxCoeff() == 1.0 || t.b.maxCoeff() == 1.0 || t.c.maxCoeff() == 1.0;
}

void add_graded(const Quadrature& rule, const Triangle& t, double area, int levels,
                RuleBuilder& builder) {
  if (levels == 0 || !touches_corner(t)) return builder.add(rule, t, area);
  for (const Triangle& child : subdivide(t, 2))
    add_graded(rule, child, area / 4, levels - 1, builder);
}

}  // namespace

Quadrature lattice_rule(int m) {
  RuleBuilder builder;
  const double third = 1.0 / 3.0;
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m - i; ++j)
      builder.add(Barycentric(i + third, j + third, m - 1 - i - j + third) / m,
                  2.0 / (m * (m + 1.0)));
  return builder.build();
}

Quadrature radon_rule() {
  const double root = std::sqrt(15.0);
  RuleBuilder builder;
  builder.add(Barycentric::Constant(1.0 / 3.0), 9.0 / 40.0);
  for (const double sign : {-1.0, 1.0}) {
    const double a = (6 + sign * root) / 21, w = (155 + sign * root) / 1200;
    for (int k = 0; k < 3; ++k) {
      Barycentric p = Barycentric::Constant(a);
      p[k] = 1 - 2 * a;
      builder.add(p, w);
    }
  }
  return builder.build();
}

Quadrature composite_rule(const Quadrature& rule, int m) { return corner_graded_rule(rule, m, 0); }

Quadrature corner_graded_rule(const Quadrature& rule, int m, int levels) {
  RuleBuilder builder;
  for (const Triangle& t : subdivide(reference(), m))
    add_graded(rule, t, 1.0 / (double(m) * m), levels, builder);
  return builder.build();
}

Quadrature guarded_rule(const Quadrature& rule, int m, double weight) {
  RuleBuilder builder;
  builder.add(rule, reference(), 1 - weight);
  const double share = weight / control_point_count(m);
  for (int i = 0; i <= m; ++i)
    for (int j = 0; j <= m - i; ++j) builder.add(Barycentric(i, j, m - i - j) / m, share);
  return builder.build();
}

}  // namespace majorant
