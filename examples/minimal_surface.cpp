// A soap film over a square: its energy is its area, the unknowns are heights, one to a node. On
// the boundary it has the heights of Scherk's surface z = log(cos y / cos x), and so it has inside.
#include "majorant/framework/newton.h"
#include "majorant/framework/terms/local_term.h"
#include "meshes.h"
#include "outcome.h"
using namespace majorant;

int main() {
  // 1. Compute the exact solution and the fixed boundary.
  const ExampleMesh mesh = square(24);
  Vec exact(mesh.points.rows());
  std::vector<FixedUnknown> boundary;
  for (Index i = 0; i < exact.size(); ++i) {
    exact[i] = std::log(std::cos(mesh.points(i, 1)) / std::cos(mesh.points(i, 0)));
    if (mesh.points.row(i).cwiseAbs().maxCoeff() == 1) boundary.push_back({i, exact[i]});
  }
  // 2. The area of a triangle with edges (u, du), (v, dv).
  const auto film = make_term<3>("area", mesh.cells, [&mesh](Index e, const auto& z) {
    using std::sqrt;
    const Eigen::Matrix3d edges = edges_from_first_corner(mesh, e);
    const auto u = edges.col(0), v = edges.col(1);
    const auto du = z[1] - z[0], dv = z[2] - z[0];
    const auto a = u[1] * dv - v[1] * du, b = v[0] * du - u[0] * dv;
    return sqrt(u.cross(v).squaredNorm() + a * a + b * b) / 2.0;
  });
  // 3. Solve from the flat film.
  ProblemBuilder builder(static_cast<Index>(exact.size()));
  const Problem problem = builder.add(film, 1).add(FixedUnknowns(boundary)).build();
  const SolveResult result = NewtonMinimizer().minimize(problem, Vec::Zero(problem.size()), {});
  const double error = (problem.expand(result.y) - exact).lpNorm<Eigen::Infinity>();
  return outcome(result, "largest error", error, 0, 2e-3);
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
