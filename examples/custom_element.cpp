// An element of one's own: Bezier hexahedra, as if the library had none (its own are
// BezierHexahedronSpace). An element of Bernstein polynomials is a description (BernsteinElement);
// tables, numbering and certificates follow from it. Energies, constraints and solvers stay as they
// are.
//
// Sample run:
//   example_custom_element block.vtk
#include <iostream>

#include "majorant/constraints/constraints.h"
#include "majorant/constraints/local_injectivity.h"
#include "majorant/elements/bernstein_space.h"
#include "majorant/energies/make_energy.h"
#include "majorant/framework/newton.h"
#include "write_vtk.h"

using namespace majorant;

// 1. Node order: Bernstein functions by the exponents of 1-r, r, 1-s, s, 1-t, t; corners first, as
// VTK has them, the rest as they come.
std::vector<Exponents> lattice(const Degrees& n) {
  constexpr int kCorners[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                  {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  const auto exponents = [&](int i, int j, int k) {
    return Exponents{n[0] - i, i, n[1] - j, j, n[2] - k, k};
  };
  std::vector<Exponents> out;
  const auto push = [&](const Exponents& e) {
    if (std::find(out.begin(), out.end(), e) == out.end()) out.push_back(e);
  };
  for (const auto& c : kCorners) push(exponents(c[0] * n[0], c[1] * n[1], c[2] * n[2]));
  for (int k = 0; k <= n[2]; ++k)
    for (int j = 0; j <= n[1]; ++j)
      for (int i = 0; i <= n[0]; ++i) push(exponents(i, j, k));
  return out;
}

// 2. The description: three factors of two corners, derivatives by r, s, t, halved in turn.
BernsteinElement hexahedron(int degree) {
  constexpr int m = EdgeBisection::kMidpoint;
  return {.name = "Hexahedra",
          .degree = degree,
          .max_degree = 3,
          .factors = {2, 2, 2},
          .lattice = lattice,
          .derivatives = {{1, 0}, {3, 2}, {5, 4}},
          .bisections = {{0, 1, {0, m, 2, 3, 4, 5}, {m, 1, 2, 3, 4, 5}},
                         {2, 3, {0, 1, 2, m, 4, 5}, {0, 1, m, 3, 4, 5}},
                         {4, 5, {0, 1, 2, 3, 4, m}, {0, 1, 2, 3, m, 5}}}};
}

class Hexahedra final : public BernsteinSpace {
 public:
  Hexahedra(const Cells& cells, Index vertex_count, int degree)
      : BernsteinSpace(hexahedron(degree), cells, vertex_count) {}
};

int main(int argc, char** argv) {
  if (argc < 2) return std::cerr << "usage: " << argv[0] << " OUT.vtk\n", 1;
  // 3. Two cubes side by side, the outer faces pressed and sheared.
  RowMatrix vertices(12, 3);
  for (Index v = 0; v < 12; ++v) vertices.row(v) << v % 3, v / 3 % 2, v / 6;
  Cells cells(2, 8);
  cells << 0, 1, 4, 3, 6, 7, 10, 9, 1, 2, 5, 4, 7, 8, 11, 10;
  auto space = std::make_shared<const Hexahedra>(cells, 12, 1);
  const RowMatrix nodes = space->node_positions(vertices);
  const RestShapes rest = curved_shapes(*space, nodes, space->default_rule(RestJacobian::Varying));
  auto energy = density<3, 3>("mips-3d", [](const auto& J) {
    return J.squaredNorm() * J.inverse().squaredNorm() + J.determinant() + 1.0 / J.determinant();
  });
  Vec x = Eigen::Map<const Vec>(nodes.data(), nodes.size());
  std::vector<FixedUnknown> held;
  for (Index k = 0; k < nodes.rows(); ++k) {
    if (nodes(k, 0) == 1) continue;
    x[3 * k + 1] += nodes(k, 0) == 2 ? 0.4 : 0.0;
    for (int c = 0; c < 3; ++c) held.push_back({3 * k + c, x[3 * k + c]});
  }
  ProblemBuilder builder(3 * space->node_count());
  builder.add(make_energy(space, rest, energy), 1 / rest.measure.sum());
  builder.add(FixedUnknowns(held));
  auto injectivity = std::make_shared<const LocalInjectivity>(space, rest.measure);
  builder.add(injectivity);
  const Problem problem = builder.build();
  const SolveResult result = NewtonMinimizer().minimize(problem, problem.reduce(x), {});
  x = problem.expand(result.y);
  std::cout << status_name(result.status) << " after " << result.iterations.size()
            << " iterations, energy " << result.energy
            << ", det J >= " << injectivity->lower_bounds(x).minCoeff() << "\n";
  write_vtk(argv[argc - 1], *space, x, 3, 79);
  return result.status == Status::Converged && injectivity->check(x).feasible ? 0 : 1;
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
