// Volumes: a bar of quadratic Bezier tetrahedra, one end held, the other twisted by soft handles,
// with the symmetric Dirichlet energy in three dimensions. det J > 0 is certified everywhere.
//
// Sample run:
//   example_twisted_bar bar.vtk
#include <cmath>
#include <iostream>
#include <numbers>

#include "majorant/constraints/constraints.h"
#include "majorant/constraints/local_injectivity.h"
#include "majorant/elements/bernstein_space.h"
#include "majorant/energies/make_energy.h"
#include "majorant/framework/newton.h"
#include "majorant/framework/terms/quadratic_penalty.h"
#include "write_vtk.h"

using namespace majorant;

constexpr int kLength = 8, kWidth = 2;

Index vertex(int i, int j, int k) { return (i * (kWidth + 1) + j) * (kWidth + 1) + k; }

// 1. A box of unit cubes, six tetrahedra around the diagonal of each (Kuhn).
Cells bar_cells() {
  constexpr int kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {2, 1, 0}, {0, 2, 1}};
  Cells cells(6 * kLength * kWidth * kWidth, 4);
  Index e = 0;
  for (int i = 0; i < kLength; ++i)
    for (int j = 0; j < kWidth; ++j)
      for (int k = 0; k < kWidth; ++k)
        for (int t = 0; t < 6; ++t) {
          int at[3] = {i, j, k};
          cells(e, 0) = vertex(i, j, k);
          for (int corner = 1; corner < 4; ++corner) {
            ++at[kOrders[t][corner - 1]];
            cells(e, corner) = vertex(at[0], at[1], at[2]);
          }
          if (t >= 3) std::swap(cells(e, 1), cells(e, 2));  // odd orders turn the other way
          ++e;
        }
  return cells;
}

RowMatrix bar_vertices() {
  RowMatrix positions((kLength + 1) * (kWidth + 1) * (kWidth + 1), 3);
  for (int i = 0; i <= kLength; ++i)
    for (int j = 0; j <= kWidth; ++j)
      for (int k = 0; k <= kWidth; ++k)
        positions.row(vertex(i, j, k)) << i, j - 0.5 * kWidth, k - 0.5 * kWidth;
  return positions;
}

int main(int argc, char** argv) {
  if (argc < 2) return std::cerr << "usage: " << argv[0] << " OUT.vtk\n", 1;
  auto space = std::make_shared<const BezierTetrahedronSpace>(
      bar_cells(), static_cast<Index>(bar_vertices().rows()), 2);
  const RestShapes rest = flat_simplices(bar_vertices(), bar_cells());
  const RowMatrix nodes = space->node_positions(bar_vertices());  // the identity map
  // 2. The energy, from one line: J is 3 by 3.
  auto energy = density<3, 3>("symmetric-dirichlet-3d", [](const auto& J) {
    return J.squaredNorm() + J.inverse().squaredNorm();
  });
  auto term = make_energy(space, rest, energy);
  auto injectivity = std::make_shared<const LocalInjectivity>(space, 6 * rest.measure);
  Vec x = Eigen::Map<const Vec>(nodes.data(), nodes.size());
  // 3. Left end held, right end pulled around the axis, 30 degrees at a time.
  SolveResult result;
  for (int degrees = 30; degrees <= 180; degrees += 30) {
    const double angle = degrees * std::numbers::pi / 180;
    std::vector<FixedUnknown> held, pulled;
    for (Index k = 0; k < nodes.rows(); ++k) {
      const double u = nodes(k, 0), y = nodes(k, 1), z = nodes(k, 2);
      const double target[3] = {u, y * std::cos(angle) - z * std::sin(angle),
                                y * std::sin(angle) + z * std::cos(angle)};
      for (int c = 0; c < 3; ++c) {
        if (u == 0) held.push_back({3 * k + c, nodes(k, c)});
        if (u == kLength) pulled.push_back({3 * k + c, target[c]});
      }
    }
    ProblemBuilder builder(3 * space->node_count());
    builder.add(term, 1 / rest.measure.sum());
    builder.add(std::make_shared<QuadraticPenalty>(FixedUnknowns(pulled)), 1e3);
    builder.add(FixedUnknowns(held));
    builder.add(injectivity);
    const Problem problem = builder.build();
    result = NewtonMinimizer().minimize(problem, problem.reduce(x), {});
    x = problem.expand(result.y);
    std::cout << degrees << " degrees: " << status_name(result.status) << " after "
              << result.iterations.size() << " iterations, energy " << result.energy
              << ", det J >= " << injectivity->lower_bounds(x).minCoeff() << "\n";
    if (result.status != Status::Converged) return 1;
  }
  write_vtk(argv[argc - 1], *space, x, 3, 78);
  return injectivity->check(x).feasible ? 0 : 1;
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
