#include "springs.h"

#include <array>
#include <cmath>
#include <numbers>

#include "majorant/framework/terms/least_squares.h"
#include "majorant/framework/terms/local_term.h"

namespace majorant::newton_suite {
namespace {

Cells pairs_of(const std::vector<std::array<Index, 2>>& pairs) {
  Cells cells(static_cast<Index>(pairs.size()), 2);
  for (std::size_t e = 0; e < pairs.size(); ++e)
    cells.row(static_cast<Index>(e)) << pairs[e][0], pairs[e][1];
  return cells;
}

Vec lengths(const Cells& ends, const Vec& x, int dim) {
  Vec l(ends.rows());
  for (Index e = 0; e < l.size(); ++e)
    l[e] = (x.segment(dim * ends(e, 0), dim) - x.segment(dim * ends(e, 1), dim)).norm();
  return l;
}

// Returns the energy of springs: stiffness rest / 2 (|d| / rest - 1)^2 each.
template <int Dim>
std::shared_ptr<const EnergyTerm> springs(const Cells& ends, const Vec& rest, double stiffness) {
  return make_term<2, Dim>("springs", ends, [rest, stiffness](Index e, const auto& z) {
    const auto strain = (z.col(1) - z.col(0)).norm() / rest[e] - 1.0;
    return stiffness / 2 * rest[e] * strain * strain;
  });
}

std::shared_ptr<const EnergyTerm> weight(Index nodes, int dim, double load) {
  Vec c = Vec::Zero(nodes * dim);
  for (Index i = dim - 1; i < c.size(); i += dim) c[i] = load;
  return linear_term("weight", c);
}

FixedUnknowns hold(const std::vector<Index>& nodes, const Vec& x, int dim) {
  std::vector<FixedUnknown> fixed;
  for (const Index node : nodes)
    for (int c = 0; c < dim; ++c) fixed.push_back({dim * node + c, x[dim * node + c]});
  return FixedUnknowns(fixed);
}

// Returns grid_edges() and one diagonal of each cell.
Cells braced_edges(Index n) {
  const Cells edges = grid_edges(n);
  Cells all(edges.rows() + n * n, 2);
  all.topRows(edges.rows()) = edges;
  for (Index c = 0; c < n * n; ++c) {
    const Index at = c / n * (n + 1) + c % n;
    all.row(edges.rows() + c) << at, at + n + 2;
  }
  return all;
}

Vec grid_points(Index n, int dim, double size) {
  Vec x = Vec::Zero((n + 1) * (n + 1) * dim);
  for (Index j = 0; j <= n; ++j)
    for (Index i = 0; i <= n; ++i) {
      x[dim * (j * (n + 1) + i)] = size * static_cast<double>(i) / static_cast<double>(n);
      x[dim * (j * (n + 1) + i) + 1] = size * static_cast<double>(j) / static_cast<double>(n);
    }
  return x;
}

template <int Dim>
SuiteInstance rope_of(int count, double roughness) {
  const double rest = 3.0 / count;
  const Cells ends = runs(count, 2);
  Vec x = Vec::Zero((count + 1) * Dim);
  for (Index i = 0; i <= count; ++i) {
    x[Dim * i] = -1 + 2.0 * static_cast<double>(i) / count;
    x[Dim * i + Dim - 1] = 0.7;
  }
  ProblemBuilder builder(x.size());
  builder.add(springs<Dim>(ends, Vec::Constant(count, rest), 10), 1)
      .add(weight(count + 1, Dim, 3.0 / count), 1)
      .add(hold({0, count}, x, Dim));
  Problem problem = builder.build();
  std::vector<Vec> starts = starts_around(problem, x, roughness);
  return {std::move(problem), std::move(starts)};
}

}  // namespace

SuiteInstance rope(int count, double roughness) { return rope_of<2>(count, roughness); }
SuiteInstance rope_in_space(int count) { return rope_of<3>(count, 0.02); }

SuiteInstance slack_net(int n) {
  const Vec x = grid_points(n, 3, 1);
  const Cells ends = grid_edges(n);
  ProblemBuilder builder(x.size());
  builder.add(springs<3>(ends, 1.1 * lengths(ends, x, 3), 10), 1)
      .add(weight((n + 1) * (n + 1), 3, 0.05), 1)
      .add(hold({0, n, n * (n + 1), (n + 1) * (n + 1) - 1}, x, 3));
  Problem problem = builder.build();
  Vec spread = Vec::Constant(x.size(), 0.002);
  for (Index i = 2; i < x.size(); i += 3) spread[i] = 0.02;
  std::vector<Vec> starts = starts_around(problem, x, spread);
  return {std::move(problem), std::move(starts)};
}

SuiteInstance tight_net(int n) {
  const Vec x = grid_points(n, 3, 1);
  const Cells ends = grid_edges(n);
  std::vector<Index> border;
  for (Index i = 0; i <= n; ++i)
    for (Index j = 0; j <= n; ++j)
      if (i == 0 || j == 0 || i == n || j == n) border.push_back(j * (n + 1) + i);
  ProblemBuilder builder(x.size());
  builder.add(springs<3>(ends, 0.9 * lengths(ends, x, 3), 10), 1)
      .add(weight((n + 1) * (n + 1), 3, 0.05), 1)
      .add(hold(border, x, 3));
  Problem problem = builder.build();
  std::vector<Vec> starts = starts_around(problem, x, 0.3);
  return {std::move(problem), std::move(starts)};
}

SuiteInstance springs_at_rest(int n, bool is_held) {
  const Vec x = grid_points(n, 2, n);
  const Cells ends = braced_edges(n);
  ProblemBuilder builder(x.size());
  builder.add(springs<2>(ends, lengths(ends, x, 2), 1), 1);
  if (is_held) builder.add(hold({0, n}, x, 2));
  Problem problem = builder.build();
  std::vector<Vec> starts = starts_around(problem, x, 0.25);
  Vec moved = x;  // so that no start is the minimum
  for (Index i = 0; i < x.size(); i += 2) moved[i] *= 1 + 0.2 * std::sin(x[i + 1]);
  starts.front() = problem.reduce(moved);
  return {std::move(problem), std::move(starts)};
}

SuiteInstance cubes_at_rest() {
  constexpr Index length = 6;
  Vec x(3 * 4 * (length + 1));
  for (Index i = 0; i <= length; ++i)
    for (Index k = 0; k < 4; ++k)
      x.segment<3>(3 * (4 * i + k)) << static_cast<double>(i), static_cast<double>(k % 2),
          static_cast<double>(k / 2);
  std::vector<std::array<Index, 2>> edges;
  for (Index a = 0; a < 4 * (length + 1); ++a)
    for (Index b = a + 1; b < 4 * (length + 1) && b / 4 <= a / 4 + 1; ++b) edges.push_back({a, b});
  const Cells ends = pairs_of(edges);
  const Problem problem =
      ProblemBuilder(x.size()).add(springs<3>(ends, lengths(ends, x, 3), 1), 1).build();
  std::vector<Vec> starts = starts_around(problem, x, 0.25);
  Vec bent = x;
  for (Index i = 0; i < x.size(); i += 3) bent[i + 2] += 0.05 * x[i] * x[i];
  starts.front() = problem.reduce(bent);
  return {problem, std::move(starts)};
}

SuiteInstance two_bar_truss(double load) {
  const Vec x{{-1, 0, 0, 0.3, 1, 0}};
  const Cells ends = pairs_of({{0, 1}, {1, 2}});
  ProblemBuilder builder(6);
  builder.add(springs<2>(ends, lengths(ends, x, 2), 100), 1)
      .add(linear_term("load", Vec{{0, 0, 0, load, 0, 0}}), 1)
      .add(hold({0, 2}, x, 2));
  Problem problem = builder.build();
  std::vector<Vec> starts = starts_around(problem, x, 0.1);
  return {std::move(problem), std::move(starts)};
}

SuiteInstance arch(int n) {
  Vec x(2 * (n + 1));
  for (Index i = 0; i <= n; ++i) {
    const double t = std::numbers::pi * static_cast<double>(i) / n;
    x.segment<2>(2 * i) << 2.0 * static_cast<double>(i) / n - 1, 0.2 * std::sin(t);
  }
  const Cells ends = runs(n, 2);
  const double h = 2.0 / n;
  ProblemBuilder builder(x.size());
  builder.add(springs<2>(ends, lengths(ends, x, 2), 1000), 1)
      .add(make_term<3, 2>("bending", runs(n - 1, 3),
                           [h](Index, const auto& z) {
                             using std::atan2;
                             const auto a = (z.col(1) - z.col(0)).eval();
                             const auto b = (z.col(2) - z.col(1)).eval();
                             const auto angle = atan2(a[0] * b[1] - a[1] * b[0], a.dot(b));
                             return angle * angle / (2 * h);
                           }),
           0.5)
      .add(weight(n + 1, 2, 40.0 / n), 1)
      .add(hold({0, n}, x, 2));
  Problem problem = builder.build();
  std::vector<Vec> starts = starts_around(problem, x, 0.02);
  return {std::move(problem), std::move(starts)};
}

namespace {

// Returns the problem sum (|d| / l - 1)^2 / 2 over all pairs, with the weights 1 / l^2 of [KK89].
SuiteInstance layout(Index nodes, const Vec& x, double spread,
                     const std::function<double(Index, Index)>& distance) {
  std::vector<std::array<Index, 2>> all;
  std::vector<double> l;
  for (Index a = 0; a < nodes; ++a)
    for (Index b = a + 1; b < nodes; ++b) {
      all.push_back({a, b});
      l.push_back(distance(a, b));
    }
  auto term = make_term<2, 2>("stress", pairs_of(all), [l](Index e, const auto& z) {
    const auto strain = (z.col(1) - z.col(0)).norm() / l[to_size(e)] - 1.0;
    return 0.5 * strain * strain;
  });
  Problem problem = ProblemBuilder(2 * nodes).add(term, 1).build();
  std::vector<Vec> starts = starts_around(problem, x, spread);
  return {std::move(problem), std::move(starts)};
}

}  // namespace

SuiteInstance ring_layout(int n) {
  Vec x(2 * n);
  for (Index i = 0; i < n; ++i) {
    const double t = 2 * std::numbers::pi * static_cast<double>(i) / n;
    x.segment<2>(2 * i) << std::cos(t), std::sin(t);
  }
  return layout(n, x, 0.3,
                [n](Index a, Index b) { return static_cast<double>(std::min(b - a, a + n - b)); });
}

SuiteInstance grid_layout(int n) {
  const Index row = n + 1;
  return layout(row * row, grid_points(n, 2, 1), 0.1, [row](Index a, Index b) {
    return static_cast<double>(std::abs(a % row - b % row) + std::abs(a / row - b / row));
  });
}

SuiteInstance sensors(double noise) {
  constexpr Index n = 30, anchors = 6;
  Uniform random(11);
  const Vec x = random.vector(2 * n);
  std::vector<std::array<Index, 2>> near;
  std::vector<double> measured;
  for (Index a = 0; a < n; ++a)
    for (Index b = a + 1; b < n; ++b) {
      const double d = (x.segment<2>(2 * a) - x.segment<2>(2 * b)).norm();
      if (d > 0.8 || b < anchors) continue;
      near.push_back({a, b});
      measured.push_back(d * (1 + noise * random()));
    }
  ProblemBuilder builder(2 * n);
  builder.add(make_least_squares<2, 2>("ranges", pairs_of(near),
                                       [measured](Index e, const auto& z) {
                                         return (z.col(1) - z.col(0)).norm() - measured[to_size(e)];
                                       }),
              1);
  builder.add(hold({0, 1, 2, 3, 4, 5}, x, 2));
  Problem problem = builder.build();
  std::vector<Vec> starts = starts_around(problem, x, 0.15);
  starts.front() = problem.reduce(x + Vec::Constant(2 * n, 0.1));
  return {std::move(problem), std::move(starts)};
}

SuiteInstance thomson(int n) {
  std::vector<std::array<Index, 2>> all;
  for (Index a = 0; a < n; ++a)
    for (Index b = a + 1; b < n; ++b) all.push_back({a, b});
  auto term = make_term<2, 3>("charges", pairs_of(all), [](Index, const auto& z) {
    const auto a = (z.col(0) / z.col(0).norm()).eval(), b = (z.col(1) / z.col(1).norm()).eval();
    return 1.0 / (a - b).norm();
  });
  Problem problem = ProblemBuilder(3 * n).add(term, 1).build();
  Vec x(3 * n);  // a spiral
  for (Index i = 0; i < n; ++i) {
    const double z = 1 - (2.0 * static_cast<double>(i) + 1) / n, r = std::sqrt(1 - z * z);
    const double t = 2.4 * static_cast<double>(i);
    x.segment<3>(3 * i) << r * std::cos(t), r * std::sin(t), z;
  }
  std::vector<Vec> starts = starts_around(problem, x, 0.4);
  return {std::move(problem), std::move(starts)};
}

SuiteInstance lennard_jones(int n) {
  std::vector<std::array<Index, 2>> all;
  for (Index a = 0; a < n; ++a)
    for (Index b = a + 1; b < n; ++b) all.push_back({a, b});
  auto term = make_term<2, 3>("atoms", pairs_of(all), [](Index, const auto& z) {
    const auto q = 1.0 / (z.col(1) - z.col(0)).squaredNorm();
    const auto p = q * q * q;
    return 4.0 * (p * p - p);
  });
  Problem problem = ProblemBuilder(3 * n).add(term, 1).build();
  Vec x(3 * n);
  for (Index i = 0; i < n; ++i) {
    const double z = 1 - (2.0 * static_cast<double>(i) + 1) / n, r = std::sqrt(1 - z * z);
    const double t = 2.4 * static_cast<double>(i);
    x.segment<3>(3 * i) << r * std::cos(t), r * std::sin(t), z;
  }
  std::vector<Vec> starts = starts_around(problem, x, 0.15);
  return {std::move(problem), std::move(starts)};
}

}  // namespace majorant::newton_suite

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
