#include "cases.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <utility>

#include "majorant/constraints/constraints.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/energies/make_energy.h"
#include "majorant/energies/materials/neo_hookean.h"
#include "majorant/energies/materials/stable_neo_hookean.h"
#include "majorant/energies/untangling.h"
#include "majorant/framework/error.h"

namespace majorant::elasticity {
namespace {

constexpr double kOnSide = 1e-9;

Cells cells_of_square(int n) {
  Cells cells(2 * n * n, 3);
  Index e = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const Index a = j * (n + 1) + i, b = a + n + 1;
      cells.row(e++) << a, a + 1, b + 1;
      cells.row(e++) << a, b + 1, b;
    }
  return cells;
}

// Returns six tetrahedra around the diagonal of each cube (Kuhn).
Cells cells_of_cube(int n) {
  constexpr int kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {2, 1, 0}, {0, 2, 1}};
  Cells cells(6 * n * n * n, 4);
  Index e = 0;
  for (int cube = 0; cube < n * n * n; ++cube)
    for (int t = 0; t < 6; ++t, ++e) {
      int at[3] = {cube % n, cube / n % n, cube / (n * n)};
      for (int corner = 0; corner < 4; ++corner) {
        if (corner > 0) ++at[kOrders[t][corner - 1]];
        cells(e, corner) = (at[2] * (n + 1) + at[1]) * (n + 1) + at[0];
      }
      if (t >= 3)
        std::swap(cells(e, 1), cells(e, 2));  // odd permutations have negative orientation
    }
  return cells;
}

RowMatrix grid(int n, int dim) {
  Index count = 1;
  for (int k = 0; k < dim; ++k) count *= n + 1;
  RowMatrix out(count, dim);
  for (Index v = 0; v < count; ++v)
    for (Index k = 0, rest = v; k < dim; ++k, rest /= n + 1)
      out(v, k) = static_cast<double>(rest % (n + 1)) / n;
  return out;
}

// Returns the rule of the suite: exact for |J|^2; the centre for degree 1.
Quadrature rule_of(const BernsteinSpace& space) {
  return exact_rule(space.element().factors, 2 * (space.degree() - 1));
}

template <class Solid>
std::shared_ptr<const EnergyTerm> energy_of(const std::shared_ptr<const BernsteinSpace>& space,
                                            const RestShapes& rest, const Solid& material,
                                            Volume volume) {
  switch (volume) {
    case Volume::Pointwise:
      return make_energy(space, rest, material, {rule_of(*space)});
    case Volume::GaussNewton:
      // The rule has as many points as there are polynomials of this degree, so that the projection
      // has det J at each point.
      return make_energy(space, rest, mean_dilatation(material, space->degree() - 1),
                         {rule_of(*space)});
    default:
      return make_energy(space, rest, mean_dilatation(material));
  }
}

template <int D>
std::shared_ptr<const EnergyTerm> energy_of(const std::shared_ptr<const BernsteinSpace>& space,
                                            const RestShapes& rest, Material material, double nu,
                                            Volume volume) {
  const LameConstants constants = constants_of(nu);
  return material == Material::NeoHookean
             ? energy_of(space, rest, neo_hookean<D>(constants), volume)
             : energy_of(space, rest, stable_neo_hookean<D>(constants), volume);
}

Vec unknowns_of(const RowMatrix& positions) {
  return Eigen::Map<const Vec>(positions.data(), positions.size());
}

template <int D, class Space>
Case stretched_block(const Block<Space>& block, Material material, double nu, Volume volume,
                     double stretch, Start start) {
  RowMatrix positions = block.nodes;
  std::vector<FixedUnknown> held;
  for (Index k = 0; k < positions.rows(); ++k) {
    const double along = positions(k, 0);
    const bool end = along > 1 - kOnSide, is_held = end || along < kOnSide;
    if (end || start == Start::Affine) positions(k, 0) *= stretch;
    for (int c = 0; is_held && c < D; ++c) held.push_back({D * k + c, positions(k, c)});
  }
  ProblemBuilder builder(static_cast<Index>(positions.size()));
  builder.add(energy_of<D>(block.space, block.rest, material, nu, volume), 1.0);
  builder.add(FixedUnknowns(held));
  const Problem problem = builder.build();
  return {problem, problem.reduce(unknowns_of(positions))};
}

Case fixed_boundary(const Square& square, const RowMatrix& positions,
                    std::shared_ptr<const EnergyTerm> term, double weight) {
  std::vector<FixedUnknown> held;
  for (const Index k : square.space->boundary_nodes())
    for (int c = 0; c < 2; ++c) held.push_back({2 * k + c, positions(k, c)});
  ProblemBuilder builder(static_cast<Index>(positions.size()));
  builder.add(std::move(term), weight);
  builder.add(FixedUnknowns(held));
  const Problem problem = builder.build();
  return {problem, problem.reduce(unknowns_of(positions))};
}

template <class Space>
constexpr int kDim = std::is_same_v<Space, BezierTriangleSpace> ? 2 : 3;

}  // namespace

LameConstants constants_of(double nu) { return {1.0, 2 * nu / (1 - 2 * nu)}; }

template <class Space>
Block<Space>::Block(int n, int degree) : vertices(grid(n, kDim<Space>)) {
  if constexpr (kDim<Space> == 2)
    cells = cells_of_square(n);
  else
    cells = cells_of_cube(n);
  space = std::make_shared<const Space>(cells, static_cast<Index>(vertices.rows()), degree);
  rest = flat_simplices(vertices, cells);
  nodes = space->node_positions(vertices);
}
template struct Block<BezierTriangleSpace>;
template struct Block<BezierTetrahedronSpace>;

Case stretched(const Square& square, Material material, double nu, Volume volume, double stretch,
               Start start) {
  return stretched_block<2>(square, material, nu, volume, stretch, start);
}
Case stretched(const Cube& cube, Material material, double nu, Volume volume, double stretch,
               Start start) {
  return stretched_block<3>(cube, material, nu, volume, stretch, start);
}

Case disk(const Square& square, const RowMatrix& positions) {
  return fixed_boundary(square, positions,
                        symmetric_dirichlet()(square.space, square.rest, {rule_of(*square.space)}),
                        1.0);
}

Case folded_solid(const Square& square, const RowMatrix& positions, double nu) {
  return fixed_boundary(
      square, positions,
      energy_of<2>(square.space, square.rest, Material::StableNeoHookean, nu, Volume::Pointwise),
      1.0);
}

Case folded_map(const Square& square, const RowMatrix& positions) {
  return fixed_boundary(
      square, positions,
      make_energy(square.space, square.rest, UntanglingDensity(1.0), {rule_of(*square.space)}),
      1 / square.rest.measure.sum());
}

int folds(const Square& square, const Vec& x) {
  const auto at = [&x](Index v) { return Vector2(x[2 * v], x[2 * v + 1]); };
  int count = 0;
  for (Index e = 0; e < square.cells.rows(); ++e) {
    const Vector2 p = at(square.cells(e, 0)), a = at(square.cells(e, 1)) - p,
                  b = at(square.cells(e, 2)) - p;
    count += !(a.x() * b.y() - a.y() * b.x() > 0);
  }
  return count;
}

std::vector<NamedStart> read_starts(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw InvalidArgument("cannot read '" + path + "'");
  std::vector<NamedStart> out;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    NamedStart start;
    Index rows = 0;
    words >> start.name >> rows;
    start.positions.resize(rows, 2);
    for (double& entry : start.positions.reshaped<Eigen::RowMajor>()) words >> entry;
    if (!words) throw InvalidArgument("'" + path + "': a line is cut short");
    out.push_back(std::move(start));
  }
  return out;
}

}  // namespace majorant::elasticity

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
