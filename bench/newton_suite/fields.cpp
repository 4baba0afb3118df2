#include "fields.h"

#include <array>
#include <cmath>
#include <numbers>

#include "majorant/framework/terms/local_term.h"

namespace majorant::newton_suite {
namespace {

template <class Z>
using ScalarOf = typename std::decay_t<Z>::Scalar;

const auto square = [](const auto& v) { return v * v; };

// Returns two right triangles per cell of an n by n grid, with the right angle at the first corner.
Cells grid_triangles(Index n) {
  Cells cells(2 * n * n, 3);
  for (Index c = 0; c < n * n; ++c) {
    const Index at = c / n * (n + 1) + c % n;
    cells.row(2 * c) << at, at + 1, at + n + 1;
    cells.row(2 * c + 1) << at + n + 2, at + n + 1, at + 1;
  }
  return cells;
}

// Returns the values of f(x, y), and the border nodes with their values.
template <class F>
Vec on_grid(Index n, const F& f) {
  Vec v((n + 1) * (n + 1));
  for (Index i = 0; i < v.size(); ++i)
    v[i] = f(static_cast<double>(i % (n + 1)) / static_cast<double>(n),
             static_cast<double>(i / (n + 1)) / static_cast<double>(n));
  return v;
}
FixedUnknowns border_at(Index n, const Vec& x, int block = 1) {
  std::vector<FixedUnknown> held;
  for (Index i = 0; i < (n + 1) * (n + 1); ++i) {
    const Index a = i % (n + 1), b = i / (n + 1);
    if (a != 0 && b != 0 && a != n && b != n) continue;
    for (int c = 0; c < block; ++c) held.push_back({block * i + c, x[block * i + c]});
  }
  return FixedUnknowns(held);
}

Cells all_nodes(Index count) { return runs(count, 1); }

// Returns the term |grad u|^2 / 2.
std::shared_ptr<const EnergyTerm> dirichlet(Index n) {
  return make_term<2>("gradient", grid_edges(n),
                      [](Index, const auto& z) { return 0.5 * square(z[1] - z[0]); });
}

SuiteInstance held_at_border(ProblemBuilder& builder, Index n, const Vec& x, double spread,
                             int block = 1) {
  Problem problem = builder.add(border_at(n, x, block)).build();
  std::vector<Vec> starts = starts_around(problem, x, spread);
  return {std::move(problem), std::move(starts)};
}

SuiteInstance around(ProblemBuilder& builder, const Vec& x, double spread) {
  Problem problem = builder.build();
  std::vector<Vec> starts = starts_around(problem, x, spread);
  return {std::move(problem), std::move(starts)};
}

}  // namespace

SuiteInstance minimal_surface(int n) {
  const double h = 1.0 / n;
  Vec x = on_grid(n, [](double a, double b) {
    return std::sin(2 * std::numbers::pi * a) * (1 - b) + (2 * a - 1) * (2 * a - 1) * b;
  });
  ProblemBuilder builder(x.size());
  builder.add(
      make_term<3>("area", grid_triangles(n),
                   [h](Index, const auto& z) {
                     using std::sqrt;
                     return 0.5 * h * h *
                            sqrt(1.0 + (square(z[1] - z[0]) + square(z[2] - z[0])) / (h * h));
                   }),
      1);
  SuiteInstance instance = held_at_border(builder, n, x, 1);
  instance.starts.front().setZero();
  return instance;
}

SuiteInstance torsion(int n, double barrier) {
  const double h = 1.0 / n;
  const Vec bound = on_grid(n, [](double a, double b) { return std::min({a, b, 1 - a, 1 - b}); });
  std::vector<Index> inner;
  for (Index i = 0; i < bound.size(); ++i)
    if (bound[i] > 0.5 * h) inner.push_back(i);
  const Cells nodes = Eigen::Map<const Cells>(inner.data(), static_cast<Index>(inner.size()), 1);
  ProblemBuilder builder(bound.size());
  builder.add(dirichlet(n), 1)
      .add(linear_term("twist", Vec::Constant(bound.size(), -20 * h * h)), 1)
      .add(make_term<1>("bounds", nodes,
                        [=](Index e, const auto& z) {
                          using std::log;
                          const double b = bound[inner[to_size(e)]];
                          return -log(b - z[0]) - log(b + z[0]);
                        }),
           barrier);
  Problem problem = builder.add(border_at(n, Vec::Zero(bound.size()))).build();
  std::vector<Vec> starts = starts_around(problem, Vec::Zero(bound.size()), 0.9 * bound);
  return {std::move(problem), std::move(starts)};
}

SuiteInstance bratu(int n, double lambda) {
  const double h = 1.0 / n;
  ProblemBuilder builder((n + 1) * (n + 1));
  builder.add(dirichlet(n), 1)
      .add(make_term<1>("source", all_nodes((n + 1) * (n + 1)),
                        [=](Index, const auto& z) {
                          using std::exp;
                          return -lambda * h * h * exp(z[0]);
                        }),
           1);
  return held_at_border(builder, n, Vec::Zero((n + 1) * (n + 1)), 1);
}

SuiteInstance p_laplacian(int n, double power) {
  const double h = 1.0 / n;
  ProblemBuilder builder((n + 1) * (n + 1));
  builder
      .add(make_term<3>("gradient", grid_triangles(n),
                        [=](Index, const auto& z) {
                          using std::pow;
                          const double small = power < 2 ? 1e-6 : 0;
                          const auto s =
                              (square(z[1] - z[0]) + square(z[2] - z[0])) / (h * h) + small;
                          return 0.5 * h * h / power * pow(s, power / 2);
                        }),
           1)
      .add(linear_term("source", Vec::Constant((n + 1) * (n + 1), -h * h)), 1);
  return held_at_border(builder, n, Vec::Zero((n + 1) * (n + 1)), 0.5);
}

SuiteInstance double_well_chain(int n, double coupling) {
  ProblemBuilder builder(n + 1);
  builder
      .add(make_term<2>("coupling", runs(n, 2),
                        [](Index, const auto& z) { return 0.5 * square(z[1] - z[0]); }),
           coupling)
      .add(make_term<1>(
               "wells", runs(n + 1, 1),
               [](Index, const auto& z) { return 0.25 * square(1.0 - z[0] * z[0]) - 0.02 * z[0]; }),
           1)
      .add(FixedUnknowns({{0, -1}, {n, 1}}));
  return around(builder, Vec::Constant(n + 1, 0), 0.5);
}

SuiteInstance phase_field(int n) {
  const double h = 1.0 / n, width = 0.08;
  Vec x = on_grid(n, [](double a, double b) {
    return (a < 1e-9 || a > 1 - 1e-9) ? 1.0 : (b < 1e-9 || b > 1 - 1e-9) ? -1.0 : 0.0;
  });
  ProblemBuilder builder(x.size());
  builder.add(dirichlet(n), width)
      .add(make_term<1>("wells", all_nodes(x.size()),
                        [=](Index, const auto& z) {
                          return h * h / (4 * width) * square(1.0 - z[0] * z[0]) -
                                 0.1 * h * h * z[0];
                        }),
           1);
  return held_at_border(builder, n, x, 0.5);
}

SuiteInstance ginzburg_landau(int n) {
  const double h = 1.0 / n, width = 0.1;
  const Index nodes = (n + 1) * (n + 1);
  Vec x = Vec::Zero(2 * nodes);
  for (Index i = 0; i < nodes; ++i) {
    const Index a = i % (n + 1), b = i / (n + 1);
    if (a != 0 && b != 0 && a != n && b != n) continue;
    const double u = static_cast<double>(a) / n - 0.5, v = static_cast<double>(b) / n - 0.5;
    x.segment<2>(2 * i) << u / std::hypot(u, v), v / std::hypot(u, v);
  }
  ProblemBuilder builder(2 * nodes);
  builder
      .add(make_term<2, 2>(
               "gradient", grid_edges(n),
               [](Index, const auto& z) { return 0.5 * (z.col(1) - z.col(0)).squaredNorm(); }),
           1)
      .add(make_term<1, 2>("wells", all_nodes(nodes),
                           [=](Index, const auto& z) {
                             return h * h / (4 * width * width) * square(1.0 - z.squaredNorm());
                           }),
           1);
  return held_at_border(builder, n, x, 0.5, 2);
}

SuiteInstance director_field(int n) {
  Vec x = on_grid(n, [](double a, double b) {
    return a < 1e-9 ? 0.0 : a > 1 - 1e-9 ? 1.2 : 0.6 * b;
  });
  ProblemBuilder builder(x.size());
  builder.add(make_term<2>("coupling", grid_edges(n),
                           [](Index, const auto& z) {
                             using std::cos;
                             return 0.5 * (1.0 - cos(2.0 * (z[1] - z[0])));
                           }),
              1);
  return held_at_border(builder, n, x, 0.3);
}

SuiteInstance total_variation(int n) {
  const double h = 1.0 / n;
  Uniform random(20);
  const Vec data = on_grid(n, [&](double a, double b) {
    return (std::abs(a - 0.5) + std::abs(b - 0.5) < 0.3 ? 1.0 : 0.0) + 0.2 * random();
  });
  ProblemBuilder builder(data.size());
  builder
      .add(make_term<3>("variation", grid_triangles(n),
                        [h](Index, const auto& z) {
                          using std::sqrt;
                          return 0.5 * h * sqrt(square(z[1] - z[0]) + square(z[2] - z[0]) + 1e-4);
                        }),
           0.1)
      .add(make_term<1>(
               "data", all_nodes(data.size()),
               [=](Index e, const auto& z) { return 0.5 * h * h * square(z[0] - data[e]); }),
           1);
  return around(builder, data, 0.5);
}

SuiteInstance analytic_center(int rows) {
  constexpr int n = 10;
  Uniform random(21);
  Eigen::MatrixXd A(rows, n);
  for (double& entry : A.reshaped()) entry = random();
  // The origin is inside, near the border.
  Vec b(rows);
  for (double& entry : b) entry = 0.02 + 1 + random();
  Cells unknowns = all_unknowns(rows, n);
  ProblemBuilder builder(n);
  builder
      .add(make_term<n>("rows", unknowns,
                        [=](Index e, const auto& z) {
                          using std::log;
                          using T = ScalarOf<decltype(z)>;
                          T s = T(b[e]);
                          for (int j = 0; j < n; ++j) s = s - A(e, j) * z[j];
                          return T(-log(s));
                        }),
           1)
      .add(make_term<1>("box", runs(n, 1),
                        [](Index, const auto& z) {
                          using std::log;
                          return -log(5.0 - z[0]) - log(5.0 + z[0]);
                        }),
           1);
  return around(builder, Vec::Zero(n), 0.002);
}

SuiteInstance chained_rosenbrock(int n) {
  Vec x(n);
  for (Index i = 0; i < n; ++i) x[i] = i % 2 ? 1 : -1.2;
  ProblemBuilder builder(n);
  builder.add(make_term<2>("chain", runs(n - 1, 2),
                           [](Index, const auto& z) {
                             return 100.0 * square(z[1] - z[0] * z[0]) + square(1.0 - z[0]);
                           }),
              1);
  return around(builder, x, 1);
}

SuiteInstance engval1(int n) {
  ProblemBuilder builder(n);
  builder.add(make_term<2>("chain", runs(n - 1, 2),
                           [](Index, const auto& z) {
                             return square(z[0] * z[0] + z[1] * z[1]) - 4.0 * z[0] + 3.0;
                           }),
              1);
  return around(builder, Vec::Constant(n, 2), 1.5);
}

SuiteInstance arwhead(int n) {
  Cells pairs(n - 1, 2);
  for (Index i = 0; i < n - 1; ++i) pairs.row(i) << i, n - 1;
  ProblemBuilder builder(n);
  builder.add(make_term<2>("arrow", pairs,
                           [](Index, const auto& z) {
                             return square(z[0] * z[0] + z[1] * z[1]) - 4.0 * z[0] + 3.0;
                           }),
              1);
  return around(builder, Vec::Ones(n), 2);
}

SuiteInstance bdqrtic(int n) {
  Cells unknowns(n - 4, 5);
  for (Index i = 0; i < n - 4; ++i) unknowns.row(i) << i, i + 1, i + 2, i + 3, n - 1;
  ProblemBuilder builder(n);
  builder.add(make_term<5>("band", unknowns,
                           [](Index, const auto& z) {
                             return square(3.0 - 4.0 * z[0]) +
                                    square(z[0] * z[0] + 2.0 * z[1] * z[1] + 3.0 * z[2] * z[2] +
                                           4.0 * z[3] * z[3] + 5.0 * z[4] * z[4]);
                           }),
              1);
  return around(builder, Vec::Ones(n), 1);
}

SuiteInstance nondquar(int n) {
  Cells triples(n - 2, 3), ends(2, 2);
  for (Index i = 0; i < n - 2; ++i) triples.row(i) << i, i + 1, n - 1;
  ends << 0, 1, n - 2, n - 1;
  Vec x(n);
  for (Index i = 0; i < n; ++i) x[i] = i % 2 ? -1 : 1;
  ProblemBuilder builder(n);
  builder
      .add(make_term<3>("chain", triples,
                        [](Index, const auto& z) { return square(square(z[0] + z[1] + z[2])); }),
           1)
      .add(make_term<2>("ends", ends,
                        [](Index e, const auto& z) {
                          return e == 0 ? square(z[0] - z[1]) : square(z[0] + z[1]);
                        }),
           1);
  return around(builder, x, 2);
}

SuiteInstance dqrtic(int n) {
  ProblemBuilder builder(n);
  builder.add(make_term<1>("powers", runs(n, 1),
                           [](Index e, const auto& z) {
                             return square(square(z[0] - static_cast<double>(e + 1)));
                           }),
              1);
  return around(builder, Vec::Constant(n, 2), 3);
}

SuiteInstance sinquad(int n) {
  Cells triples(n - 2, 3), ends(1, 2);
  for (Index i = 1; i < n - 1; ++i) triples.row(i - 1) << 0, i, n - 1;
  ends << 0, n - 1;
  ProblemBuilder builder(n);
  builder
      .add(make_term<3>("arrow", triples,
                        [](Index, const auto& z) {
                          using std::sin;
                          return square(sin(z[1] - z[2]) - z[0] * z[0] + z[1] * z[1]);
                        }),
           1)
      .add(make_term<2>("ends", ends,
                        [](Index, const auto& z) {
                          return square(square(z[0] - 1.0)) + square(z[1] * z[1] - z[0] * z[0]);
                        }),
           1);
  return around(builder, Vec::Constant(n, 0.1), 0.1);
}

SuiteInstance cragglvy(int n) {
  Cells fours((n - 2) / 2, 4);
  for (Index i = 0; i < fours.rows(); ++i)
    for (int k = 0; k < 4; ++k) fours(i, k) = 2 * i + k;
  Vec x = Vec::Constant(n, 2);
  x[0] = 1;
  ProblemBuilder builder(n);
  builder.add(make_term<4>("chain", fours,
                           [](Index, const auto& z) {
                             using std::exp;
                             using std::tan;
                             const auto s = z[2] - z[3];
                             return square(square(exp(z[0]) - z[1])) +
                                    100.0 * square(square(z[1] - z[2]) * (z[1] - z[2])) +
                                    square(square(tan(s) + s)) + square(square(square(z[0]))) +
                                    square(z[3] - 1.0);
                           }),
              1);
  return around(builder, x, 0.1);
}

SuiteInstance quadratic() {
  ProblemBuilder builder(2);
  builder.add(make_term<2>("quadratic", runs(1, 2),
                           [](Index, const auto& z) { return square(z[0]) + square(z[1] - 1.0); }),
              1);
  return around(builder, Vec{{3, -2}}, 10);
}

SuiteInstance stiff_quadratic(int n) {
  ProblemBuilder builder(n);
  builder
      .add(make_term<1>("diagonal", runs(n, 1),
                        [n](Index e, const auto& z) {
                          const double d =
                              std::pow(10, 12.0 * static_cast<double>(e) / (n - 1) - 6);
                          return 0.5 * d * square(z[0] - 1.0);
                        }),
           1)
      .add(make_term<2>("coupling", runs(n - 1, 2),
                        [](Index, const auto& z) { return 0.5 * square(z[1] - z[0]); }),
           1e-3);
  return around(builder, Vec::Zero(n), 10);
}

SuiteInstance quartic_chain(int n) {
  ProblemBuilder builder(n + 1);
  builder
      .add(make_term<2>("chain", runs(n, 2),
                        [](Index, const auto& z) { return square(square(z[1] - z[0])); }),
           1)
      .add(FixedUnknowns({{0, 0}}));
  return around(builder, Vec::LinSpaced(n + 1, 0, 3), 1);
}

SuiteInstance crossing_valleys() {
  ProblemBuilder builder(2);
  builder.add(make_term<2>("valleys", runs(1, 2),
                           [](Index, const auto& z) {
                             return square(z[0] * z[1]) + 1e-4 * square(z[0] - 1.0) +
                                    1e-4 * square(z[1] - 2.0);
                           }),
              1);
  return around(builder, Vec{{3, 0.1}}, 2);
}

SuiteInstance saddle() {
  ProblemBuilder builder(2);
  builder.add(make_term<2>("saddle", runs(1, 2),
                           [](Index, const auto& z) {
                             const auto s = z[1] * z[1];
                             return z[0] * z[0] - s + s * s;
                           }),
              1);
  return around(builder, Vec{{1, 1e-6}}, 0.5);
}

SuiteInstance monkey_saddle() {
  ProblemBuilder builder(2);
  builder.add(make_term<2>("saddle", runs(1, 2),
                           [](Index, const auto& z) {
                             const auto a = z[0] * z[0], b = z[1] * z[1];
                             return z[0] * (a - 3.0 * b) + 0.25 * square(a + b);
                           }),
              1);
  return around(builder, Vec{{1e-3, 1e-3}}, 0.5);
}

SuiteInstance many_saddles(int n) {
  ProblemBuilder builder(2 * n);
  builder
      .add(make_term<1, 2>("saddles", runs(n, 1),
                           [](Index, const auto& z) {
                             const auto s = z(1, 0) * z(1, 0);
                             return z(0, 0) * z(0, 0) - s + 0.5 * s * s;
                           }),
           1)
      .add(make_term<2, 2>(
               "coupling", runs(n - 1, 2),
               [](Index, const auto& z) { return 20.0 * (z.col(1) - z.col(0)).squaredNorm(); }),
           1);
  Vec x = Vec::Ones(2 * n);
  for (Index i = 1; i < x.size(); i += 2) x[i] = 1e-3;
  return around(builder, x, 0.5);
}

SuiteInstance logarithm() {
  ProblemBuilder builder(1);
  builder.add(make_term<1>("logarithm", runs(1, 1),
                           [](Index, const auto& z) {
                             using std::log;
                             return -log(z[0]);
                           }),
              1);
  return around(builder, Vec::Ones(1), 0.9);
}

SuiteInstance linear() {
  ProblemBuilder builder(3);
  builder.add(linear_term("linear", Vec{{1, -2, 0.5}}), 1);
  return around(builder, Vec::Ones(3), 1);
}

SuiteInstance distances_squared(int n) {
  const Cells edges = grid_edges(n);
  const Index nodes = (n + 1) * (n + 1);
  Cells diagonals(2 * n * n, 2);
  for (Index c = 0; c < n * n; ++c) {
    const Index at = c / n * (n + 1) + c % n;
    diagonals.row(2 * c) << at, at + n + 2;
    diagonals.row(2 * c + 1) << at + 1, at + n + 1;
  }
  const auto term = [](const char* name, const Cells& ends, double l2) {
    return make_term<2, 2>(name, ends, [l2](Index, const auto& z) {
      return 0.25 * square((z.col(1) - z.col(0)).squaredNorm() - l2);
    });
  };
  ProblemBuilder builder(2 * nodes);
  builder.add(term("edges", edges, 1), 1).add(term("diagonals", diagonals, 2), 1);
  Vec x(2 * nodes);
  for (Index i = 0; i < nodes; ++i)
    x.segment<2>(2 * i) << static_cast<double>(i % (n + 1)), static_cast<double>(i / (n + 1));
  SuiteInstance instance = around(builder, x, 0.25);
  Vec moved = x;
  for (Index i = 0; i < x.size(); i += 2) moved[i] *= 1 + 0.2 * std::sin(x[i + 1]);
  instance.starts.front() = moved;
  return instance;
}

}  // namespace majorant::newton_suite

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
