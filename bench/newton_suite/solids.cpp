#include "solids.h"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "majorant/framework/terms/local_term.h"

namespace majorant::newton_suite {
namespace {

struct Lame {
  double mu, lambda;
  Lame(double nu) : mu(0.5 / (1 + nu)), lambda(nu / ((1 + nu) * (1 - 2 * nu))) {}
};

template <class T, int Dim>
using Square = Eigen::Matrix<T, Dim, Dim>;

template <class T>
T determinant(const Square<T, 2>& F) {
  return F(0, 0) * F(1, 1) - F(0, 1) * F(1, 0);
}
template <class T>
T determinant(const Square<T, 3>& F) {
  return F(0, 0) * (F(1, 1) * F(2, 2) - F(1, 2) * F(2, 1)) -
         F(0, 1) * (F(1, 0) * F(2, 2) - F(1, 2) * F(2, 0)) +
         F(0, 2) * (F(1, 0) * F(2, 1) - F(1, 1) * F(2, 0));
}

// Returns the energy density, which is 0 and free of stress at rest.
template <int Dim, class T>
T density(Material material, const Lame& c, const Square<T, Dim>& F) {
  using std::log;
  using std::sqrt;
  const T norm = F.squaredNorm();
  switch (material) {
    case Material::StableNeoHookean: {
      const double bend = 1 - 1 / (Dim + 1.0), alpha = 1 + bend * c.mu / c.lambda;
      const T off = determinant(F) - alpha;
      const double rest =
          0.5 * c.lambda * (1 - alpha) * (1 - alpha) - 0.5 * c.mu * std::log(Dim + 1.0);
      return 0.5 * c.mu * (norm - Dim) + 0.5 * c.lambda * off * off - 0.5 * c.mu * log(norm + 1.0) -
             rest;
    }
    case Material::NeoHookean: {
      const T J = determinant(F);
      if (!(J > 0.0)) return T(std::numeric_limits<double>::infinity());
      const T l = log(J);
      return 0.5 * c.mu * (norm - Dim) - c.mu * l + 0.5 * c.lambda * l * l;
    }
    case Material::SaintVenantKirchhoff: {
      const Square<T, Dim> C = F.transpose() * F;
      const T trace = 0.5 * (norm - Dim);  // trace of the strain
      T strain = T(0.0);
      for (int i = 0; i < Dim; ++i)
        for (int j = 0; j < Dim; ++j) {
          const T e = 0.5 * (C(i, j) - (i == j ? 1.0 : 0.0));
          strain = strain + e * e;
        }
      return c.mu * strain + 0.5 * c.lambda * trace * trace;
    }
    default: {
      const T a = F(0, 0) + F(1, 1), b = F(1, 0) - F(0, 1);
      const T stretch = sqrt(a * a + b * b);  // the trace of R^T F
      return c.mu * (norm - 2.0 * stretch + 2.0) +
             0.5 * c.lambda * (stretch - 2.0) * (stretch - 2.0);
    }
  }
}

// Returns the energy of linear simplices. x: rest positions.
template <int Dim>
std::shared_ptr<const EnergyTerm> solid(const Cells& cells, const Vec& x, Material material,
                                        double nu) {
  std::vector<Square<double, Dim>> inverse;
  std::vector<double> measure;
  for (Index e = 0; e < cells.rows(); ++e) {
    Square<double, Dim> D;
    for (int k = 0; k < Dim; ++k)
      D.col(k) = x.segment<Dim>(Dim * cells(e, k + 1)) - x.segment<Dim>(Dim * cells(e, 0));
    inverse.push_back(D.inverse());
    measure.push_back(std::abs(D.determinant()) / (Dim == 2 ? 2 : 6));
  }
  const Lame c(nu);
  return make_term<Dim + 1, Dim>("solid", cells, [=](Index e, const auto& z) {
    using T = typename std::decay_t<decltype(z)>::Scalar;
    Square<T, Dim> D;
    for (int k = 0; k < Dim; ++k) D.col(k) = z.col(k + 1) - z.col(0);
    const Square<T, Dim> F = D * inverse[to_size(e)];
    return T(measure[to_size(e)] * density<Dim, T>(material, c, F));
  });
}

struct Mesh {
  Cells cells;
  Vec x;
};

// Returns a grid with two triangles per cell, whose diagonals alternate.
Mesh plane_grid(Index nx, Index ny, double lx, double ly) {
  Mesh m;
  m.x.resize(2 * (nx + 1) * (ny + 1));
  m.cells.resize(2 * nx * ny, 3);
  for (Index j = 0; j <= ny; ++j)
    for (Index i = 0; i <= nx; ++i)
      m.x.segment<2>(2 * (j * (nx + 1) + i))
          << lx * static_cast<double>(i) / static_cast<double>(nx),
          ly * static_cast<double>(j) / static_cast<double>(ny);
  Index e = 0;
  for (Index j = 0; j < ny; ++j)
    for (Index i = 0; i < nx; ++i) {
      const Index a = j * (nx + 1) + i, b = a + 1, c = a + nx + 1, d = c + 1;
      if ((i + j) % 2) {
        m.cells.row(e++) << a, b, d;
        m.cells.row(e++) << a, d, c;
      } else {
        m.cells.row(e++) << a, b, c;
        m.cells.row(e++) << b, d, c;
      }
    }
  return m;
}

// Returns a grid with six tetrahedra around the diagonal of each cube.
Mesh space_grid(Index nx, Index ny, Index nz, double h) {
  Mesh m;
  const auto node = [&](Index i, Index j, Index k) { return (k * (ny + 1) + j) * (nx + 1) + i; };
  m.x.resize(3 * (nx + 1) * (ny + 1) * (nz + 1));
  m.cells.resize(6 * nx * ny * nz, 4);
  for (Index k = 0; k <= nz; ++k)
    for (Index j = 0; j <= ny; ++j)
      for (Index i = 0; i <= nx; ++i)
        m.x.segment<3>(3 * node(i, j, k)) << h * static_cast<double>(i), h * static_cast<double>(j),
            h * static_cast<double>(k);
  constexpr int kOrders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  Index e = 0;
  for (Index k = 0; k < nz; ++k)
    for (Index j = 0; j < ny; ++j)
      for (Index i = 0; i < nx; ++i)
        for (const auto& order : kOrders) {
          std::array<Index, 3> at{i, j, k};
          m.cells(e, 0) = node(at[0], at[1], at[2]);
          for (int step = 0; step < 3; ++step) {
            ++at[to_size(order[step])];
            m.cells(e, step + 1) = node(at[0], at[1], at[2]);
          }
          ++e;
        }
  return m;
}

std::shared_ptr<const EnergyTerm> pull(Index size, int dim, double each) {
  Vec c = Vec::Zero(size);
  for (Index i = dim - 1; i < size; i += dim) c[i] = each;
  return linear_term("load", c);
}

// Returns the problem of a bar along x. `moved`: the ends at their fixed positions, interpolated in
// between.
template <int Dim>
SuiteInstance bar(const Mesh& mesh, double length, double cell, Material material, double nu,
                  const BarLoad& load, double spread) {
  const Vec& x = mesh.x;
  Vec ramp = x;
  std::vector<FixedUnknown> fixed;
  for (Index i = 0; i < x.size(); i += Dim) {
    const double t = x[i] / length, turn = t * load.twist * std::numbers::pi / 180;
    ramp[i] = load.stretch * x[i];
    if constexpr (Dim == 3) {
      const double a = x[i + 1] - 0.5, b = x[i + 2] - 0.5;
      ramp[i + 1] = 0.5 + std::cos(turn) * a - std::sin(turn) * b;
      ramp[i + 2] = 0.5 + std::sin(turn) * a + std::cos(turn) * b;
    } else {
      const double a = x[i + 1] - 0.5;
      ramp[i] -= std::sin(turn) * a;
      ramp[i + 1] = 0.5 + std::cos(turn) * a;
    }
    ramp[i + Dim - 1] += load.shear * t;
    const bool is_end = t < 1e-9 || (t > 1 - 1e-9 && load.gravity == 0);
    for (int c = 0; c < Dim && is_end; ++c) fixed.push_back({i + c, ramp[i + c]});
  }
  ProblemBuilder builder(x.size());
  builder.add(solid<Dim>(mesh.cells, x, material, nu), 1);
  if (load.gravity != 0) builder.add(pull(x.size(), Dim, load.gravity), 1);
  builder.add(FixedUnknowns(fixed));
  Problem problem = builder.build();
  const Vec& natural = load.jumps ? x : ramp;
  std::vector<Vec> starts = starts_around(problem, natural, spread * cell);
  return {std::move(problem), std::move(starts)};
}

}  // namespace

SuiteInstance plane_bar(Material material, double nu, const BarLoad& load) {
  return bar<2>(plane_grid(12, 3, 4, 1), 4, 1.0 / 3, material, nu, load,
                material == Material::NeoHookean ? 0.1 : 0.3);
}

SuiteInstance space_bar(Material material, double nu, const BarLoad& load) {
  return bar<3>(space_grid(6, 2, 2, 0.5), 3, 0.5, material, nu, load,
                material == Material::NeoHookean ? 0.05 : 0.2);
}

SuiteInstance free_plate(Material material, double nu) {
  const Mesh mesh = plane_grid(6, 6, 2, 2);
  const Problem problem =
      ProblemBuilder(mesh.x.size()).add(solid<2>(mesh.cells, mesh.x, material, nu), 1).build();
  std::vector<Vec> starts = starts_around(problem, mesh.x, 0.08);
  Vec sheared = mesh.x;
  for (Index i = 0; i < sheared.size(); i += 2) sheared[i] += 0.3 * mesh.x[i + 1] * mesh.x[i + 1];
  starts.front() = problem.reduce(sheared);
  return {problem, std::move(starts)};
}

SuiteInstance column(int n, double load) {
  const double h = 1.0 / n, critical = std::numbers::pi * std::numbers::pi / 4;
  // theta_0 = 0 is fixed. Pieces of constant angle bend at the joints, and the load sinks.
  ProblemBuilder builder(n + 1);
  builder.add(make_term<2>("bending", runs(n, 2),
                           [h](Index, const auto& z) {
                             const auto d = z[1] - z[0];
                             return d * d / (2 * h);
                           }),
              1);
  Cells each(n, 1);
  for (Index i = 0; i < n; ++i) each(i, 0) = i + 1;
  builder.add(make_term<1>("load", each,
                           [=](Index, const auto& z) {
                             using std::cos;
                             return load * critical * h * cos(z[0]);
                           }),
              1);
  builder.add(FixedUnknowns({{0, 0}}));
  Problem problem = builder.build();
  std::vector<Vec> starts = starts_around(problem, Vec::Zero(n + 1), 0.1);
  starts.front() = problem.reduce(Vec::LinSpaced(n + 1, 0, 1e-3));
  return {std::move(problem), std::move(starts)};
}

namespace {

std::shared_ptr<const EnergyTerm> rod_bending(const Cells& triples, double h) {
  return make_term<3, 2>("bending", triples, [h](Index, const auto& z) {
    using std::atan2;
    const auto a = (z.col(1) - z.col(0)).eval(), b = (z.col(2) - z.col(1)).eval();
    const auto angle = atan2(a[0] * b[1] - a[1] * b[0], a.dot(b));
    return angle * angle / (2 * h);
  });
}

std::shared_ptr<const EnergyTerm> rod_stretching(const Cells& pairs, double h, double stiffness) {
  return make_term<2, 2>("stretching", pairs, [=](Index, const auto& z) {
    const auto strain = (z.col(1) - z.col(0)).norm() / h - 1.0;
    return stiffness / 2 * h * strain * strain;
  });
}

Vec straight(Index n, double length) {
  Vec x = Vec::Zero(2 * (n + 1));
  for (Index i = 0; i <= n; ++i)
    x[2 * i] = length * static_cast<double>(i) / static_cast<double>(n);
  return x;
}

FixedUnknowns nodes_at(const std::vector<Index>& nodes, const Vec& x) {
  std::vector<FixedUnknown> fixed;
  for (const Index node : nodes)
    for (int c = 0; c < 2; ++c) fixed.push_back({2 * node + c, x[2 * node + c]});
  return FixedUnknowns(fixed);
}

}  // namespace

SuiteInstance elastica(int n, double gap) {
  const double h = 1.0 / n;
  Vec x = straight(n, gap);
  for (const Index i : {Index(1), Index(n - 1)}) x[2 * i] = i == 1 ? h : gap - h;
  ProblemBuilder builder(x.size());
  builder.add(rod_bending(runs(n - 1, 3), h), 1)
      .add(rod_stretching(runs(n, 2), h, 1e5), 1)
      .add(nodes_at({0, 1, n - 1, n}, x));
  Problem problem = builder.build();
  Vec natural = x, spread = Vec::Zero(x.size());
  for (Index i = 0; i <= n; ++i) {
    const double t = static_cast<double>(i) / n;
    natural[2 * i + 1] = 0.2 * std::sin(std::numbers::pi * t) * std::sin(std::numbers::pi * t);
    spread[2 * i + 1] = 0.3 * h;
    spread[2 * i] = 0.1 * h;
  }
  std::vector<Vec> starts = starts_around(problem, natural, spread);
  return {std::move(problem), std::move(starts)};
}

SuiteInstance closed_rod(int n) {
  Cells pairs(n, 2), triples(n, 3);
  Vec x(2 * n);
  const double h = 2 * std::numbers::pi / n;
  for (Index i = 0; i < n; ++i) {
    pairs.row(i) << i, (i + 1) % n;
    triples.row(i) << i, (i + 1) % n, (i + 2) % n;
    const double t = h * static_cast<double>(i);
    x.segment<2>(2 * i) << 1.5 * std::cos(t), 0.4 * std::sin(t);
  }
  const Problem problem = ProblemBuilder(2 * n)
                              .add(rod_bending(triples, h), 1)
                              .add(rod_stretching(pairs, h, 1e3), 1)
                              .build();
  std::vector<Vec> starts = starts_around(problem, x, 0.03);
  return {problem, std::move(starts)};
}

SuiteInstance wrinkles(int n) {
  const double h = 1.0 / n;
  const Vec x = straight(n, 0.9);
  Vec stiff = Vec::Zero(x.size());
  Cells heights(n + 1, 1);
  for (Index i = 0; i <= n; ++i) heights(i, 0) = 2 * i + 1;
  ProblemBuilder builder(x.size());
  builder.add(rod_bending(runs(n - 1, 3), h), 1)
      .add(rod_stretching(runs(n, 2), h, 1e4), 1)
      .add(make_term<1>("foundation", heights,
                        [h](Index, const auto& z) { return h / 2 * z[0] * z[0]; }),
           1e4)
      .add(nodes_at({0, n}, x));
  Problem problem = builder.build();
  Vec natural = x, spread = Vec::Constant(x.size(), 0.1 * h);
  for (Index i = 0; i <= n; ++i)
    natural[2 * i + 1] = 0.05 * std::sin(3 * std::numbers::pi * static_cast<double>(i) / n);
  std::vector<Vec> starts = starts_around(problem, natural, spread);
  return {std::move(problem), std::move(starts)};
}

SuiteInstance rope_over_disk(int n, double barrier) {
  Vec x(2 * (n + 1));
  for (Index i = 0; i <= n; ++i) {
    const double t = -1 + 2.0 * static_cast<double>(i) / n;
    x.segment<2>(2 * i) << t, 0.7;
  }
  Cells each(n + 1, 1);
  for (Index i = 0; i <= n; ++i) each(i, 0) = i;
  ProblemBuilder builder(x.size());
  builder.add(rod_stretching(runs(n, 2), 2.6 / n, 10), 1)
      .add(pull(x.size(), 2, 3.0 / n), 1)
      .add(make_term<1, 2>("disk", each,
                           [](Index, const auto& z) {
                             using std::log;
                             return -log(z.squaredNorm() - 0.25);
                           }),
           barrier)
      .add(nodes_at({0, n}, x));
  Problem problem = builder.build();
  std::vector<Vec> starts = starts_around(problem, x, 0.02);
  return {std::move(problem), std::move(starts)};
}

SuiteInstance block_on_floor(double nu) {
  Mesh mesh = plane_grid(6, 6, 1, 1);
  for (Index i = 1; i < mesh.x.size(); i += 2) mesh.x[i] += 0.2;
  Cells each(mesh.x.size() / 2, 1);
  for (Index i = 0; i < each.rows(); ++i) each(i, 0) = i;
  ProblemBuilder builder(mesh.x.size());
  builder.add(solid<2>(mesh.cells, mesh.x, Material::StableNeoHookean, nu), 1)
      .add(pull(mesh.x.size(), 2, 0.002), 1)
      .add(make_term<1, 2>("floor", each,
                           [](Index, const auto& z) {
                             using T = typename std::decay_t<decltype(z)>::Scalar;
                             const T depth = -z(1, 0);
                             return depth > 0.0 ? T(depth * depth * depth) : T(0.0);
                           }),
           1e3)
      .add(FixedUnknowns({{0, mesh.x[0]}}));
  Problem problem = builder.build();
  std::vector<Vec> starts = starts_around(problem, mesh.x, 0.03);
  return {std::move(problem), std::move(starts)};
}

SuiteInstance obstacle(int n, double barrier) {
  const Mesh mesh = plane_grid(n, n, 1, 1);
  const Index nodes = mesh.x.size() / 2;
  const Vec x = mesh.x;
  Cells each(nodes, 1);
  std::vector<FixedUnknown> border;
  Vec bump(nodes);
  for (Index i = 0; i < nodes; ++i) {
    each(i, 0) = i;
    const double a = x[2 * i] - 0.5, b = x[2 * i + 1] - 0.5;
    bump[i] = 0.3 - 3 * (a * a + b * b);
    if (std::max(std::abs(a), std::abs(b)) > 0.5 - 1e-9) border.push_back({i, 0});
  }
  ProblemBuilder builder(nodes);
  builder
      .add(make_term<2>("membrane", grid_edges(n),
                        [](Index, const auto& z) {
                          const auto d = z[1] - z[0];
                          return 0.5 * d * d;
                        }),
           1)
      .add(make_term<1>("obstacle", each,
                        [bump](Index e, const auto& z) {
                          using std::log;
                          return -log(z[0] - bump[e]);
                        }),
           barrier)
      .add(FixedUnknowns(border));
  Problem problem = builder.build();
  std::vector<Vec> starts = starts_around(problem, Vec::Constant(nodes, 0.6), 0.2);
  return {std::move(problem), std::move(starts)};
}

SuiteInstance disks_in_box(int count) {
  constexpr double radius = 0.5, width = 1.6;
  const double reach = 0.1;  // distance at which the barrier begins
  // Two unknowns per disk. The barrier acts on distances between disks and to three walls.
  Cells pairs(count * (count - 1) / 2, 2), each(count, 1);
  Index e = 0;
  for (Index a = 0; a < count; ++a) {
    each(a, 0) = a;
    for (Index b = a + 1; b < count; ++b) pairs.row(e++) << a, b;
  }
  const auto barrier = [reach](const auto& d) {
    using T = std::decay_t<decltype(d)>;
    using std::log;
    if (!(d > 0.0)) return T(std::numeric_limits<double>::infinity());
    if (d > reach) return T(0.0);
    const T off = d - reach;
    return T(-off * off * log(d / reach));
  };
  ProblemBuilder builder(2 * count);
  builder
      .add(make_term<2, 2>("disks", pairs,
                           [barrier](Index, const auto& z) {
                             using T = typename std::decay_t<decltype(z)>::Scalar;
                             const T d = (z.col(1) - z.col(0)).norm() - 2 * radius;
                             return barrier(d);
                           }),
           100)
      .add(make_term<1, 2>("walls", each,
                           [barrier](Index, const auto& z) {
                             using T = typename std::decay_t<decltype(z)>::Scalar;
                             const T left = z(0, 0) - radius, right = width - radius - z(0, 0);
                             const T floor = z(1, 0) - radius;
                             return T(barrier(left) + barrier(right) + barrier(floor));
                           }),
           100)
      .add(pull(2 * count, 2, 1), 1);
  Problem problem = builder.build();
  Vec x(2 * count), spread(2 * count);
  for (Index i = 0; i < count; ++i) {
    x.segment<2>(2 * i) << (i % 2 ? 1.05 : 0.55), 0.6 + 1.05 * static_cast<double>(i);
    spread.segment<2>(2 * i) << 0.02, 0.02;
  }
  std::vector<Vec> starts = starts_around(problem, x, spread);
  return {std::move(problem), std::move(starts)};
}

}  // namespace majorant::newton_suite

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
