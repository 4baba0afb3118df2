// A beam of rubber, clamped at one end, hangs under its own weight: neo-Hookean tetrahedra, their
// rest shapes as data of the lambda. Where a tetrahedron turns over, log J is NaN: outside of the
// domain, so no step goes there.
#include "majorant/framework/newton.h"
#include "majorant/framework/terms/local_term.h"
#include "meshes.h"
#include "outcome.h"
using namespace majorant;

int main() {
  // 1. Each tetrahedron's rest shape, inverted, its volume and its part of the weight.
  const ExampleMesh beam = bar(10, 2);
  std::vector<Eigen::Matrix3d> inverse;
  Vec volume(beam.cells.rows()), weight = Vec::Zero(beam.points.size());
  for (Index e = 0; e < volume.size(); ++e) {
    const Eigen::Matrix3d edges = edges_from_first_corner(beam, e);
    inverse.push_back(edges.inverse());
    volume[e] = edges.determinant() / 6;
    for (const Index corner : beam.cells.row(e)) weight[3 * corner + 2] += 0.002 * volume[e] / 4;
  }
  // 2. Energy density mu / 2 (|F|^2 - 3) - mu log J + lambda / 2 log^2 J with mu = 1, lambda = 2.
  const auto rubber = make_term<4, 3>("neo-Hooke", beam.cells, [=](Index e, const auto& z) {
    using std::log;
    const auto edges = (z.template rightCols<3>().colwise() - z.col(0)).eval();
    const auto F = (edges * inverse[e]).eval();
    const auto log_J = log(F.determinant());
    return volume[e] * (0.5 * (F.squaredNorm() - 3.0) - log_J + log_J * log_J);
  });
  // 3. Clamp one end and solve.
  ProblemBuilder builder(static_cast<Index>(weight.size()));
  builder.add(rubber, 1).add(linear_term("weight", weight), 1);
  const Problem problem = builder.add(held(beam.points, {0, 1, 2, 3, 4, 5, 6, 7, 8})).build();
  const Vec start = problem.reduce(unknowns_of(beam.points));
  const SolveResult result = NewtonMinimizer().minimize(problem, start, {});
  return outcome(result, "height of the end", problem.expand(result.y).tail(1)[0], 0.5710538, 1e-6);
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
