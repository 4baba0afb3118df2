// Euler's elastica: a thin rod, clamped at both ends, which are pushed together. Bending couples
// three points, stretching two: a term of one lambda each. The height of the arc is compared with
// the closed form, in which K and E are the elliptic integrals of the modulus k.
#include "majorant/framework/energy_term.h"
#include "majorant/framework/newton.h"
#include "majorant/framework/terms/local_term.h"
#include "meshes.h"
#include "outcome.h"
using namespace majorant;

int main() {
  // 1. A polyline of length 1 between the clamps, with k = 1/2.
  constexpr Index n = 201;
  constexpr double k = 0.5, edge = 1.0 / (n - 2);
  const double K = std::comp_ellint_1(k), E = std::comp_ellint_2(k);
  const RowMatrix points = clamped_polyline(n, 2 * E / K - 1);
  // 2. Curvature squared, and a stiff spring for each edge.
  const auto bending = make_term<3, 2>("bending", runs_of(3, n), [](Index, const auto& z) {
    using std::atan2;
    const auto a = (z.col(1) - z.col(0)).eval(), b = (z.col(2) - z.col(1)).eval();
    const auto angle = atan2(a[0] * b[1] - a[1] * b[0], a.dot(b));
    return angle * angle / (2 * edge);
  });
  const auto springs = make_term<2, 2>("springs", runs_of(2, n), [](Index, const auto& z) {
    const auto stretch = (z.col(1) - z.col(0)).norm() / edge - 1.0;
    return 1e6 * edge * stretch * stretch;
  });
  // 3. Clamp both ends and solve.
  ProblemBuilder builder(2 * n);
  builder.add(bending, 1).add(springs, 1).add(held(points, {0, 1, n - 2, n - 1}));
  const Problem problem = builder.build();
  const Vec start = problem.reduce(unknowns_of(points));
  const SolveResult result = NewtonMinimizer().minimize(problem, start, {});
  const Vec x = problem.expand(result.y);
  if (!check_derivatives(*bending, x).ok()) return 1;
  return outcome(result, "height", x[n], k / K, 1e-4);
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
