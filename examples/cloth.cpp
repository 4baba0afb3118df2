// A sheet of cloth buckles between two sides that are pushed together: springs along its edges,
// bending by the angle between neighbouring triangles. bench/cloth_ceres.cpp is the same with
// Ceres.
//
// Sample run:
//   example_cloth
#include "cloth.h"

#include "majorant/framework/newton.h"
#include "majorant/framework/terms/local_term.h"
#include "outcome.h"
using namespace majorant;

int main() {
  const Cloth sheet = cloth(60);
  // 1. Springs: (length - L)^2 / L. An element is an edge, its lambda sees the two ends as columns.
  const auto springs = make_term<2, 3>("springs", sheet.edges, [&](Index e, const auto& z) {
    const double L = (sheet.flat.row(sheet.edges(e, 0)) - sheet.flat.row(sheet.edges(e, 1))).norm();
    const auto stretch = (z.col(1) - z.col(0)).norm() - L;
    return stretch * stretch / L;
  });
  // 2. Bending: 0.001 angle^2 at each inner edge.
  const auto hinges = make_term<4, 3>("bending", sheet.hinges, [](Index, const auto& z) {
    using std::atan2;
    const auto edge = (z.col(1) - z.col(0)).eval();
    const auto left = edge.cross(z.col(2) - z.col(0)).eval();
    const auto right = (z.col(3) - z.col(0)).cross(edge).eval();
    const auto angle = atan2(left.cross(right).dot(edge) / edge.norm(), left.dot(right));
    return 0.001 * angle * angle;
  });
  // 3. The two sides stay where they are.
  ProblemBuilder builder(static_cast<Index>(sheet.start.size()));
  builder.add(springs, 1).add(hinges, 1).add(held(sheet.start, sheet.held));
  const Problem problem = builder.build();
  const Vec start = problem.reduce(unknowns_of(sheet.start));
  const SolveResult result = NewtonMinimizer().minimize(problem, start, {});
  return outcome(result, "energy", result.energy, 0.002004073983, 1e-11);
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
