// Uses the framework as an installed package: a problem without a mesh or a file. A chain of
// springs of length 1, held at both ends, is stretched: every spring has the same length.
#include <cmath>
#include <cstdio>

#include "majorant/elements/quadrature.h"
#include "majorant/framework/newton.h"
#include "majorant/framework/terms/local_term.h"

using namespace majorant;

int main() {
  constexpr Index kKnots = 50;
  Cells ends(kKnots - 1, 2);
  for (Index e = 0; e + 1 < kKnots; ++e) ends.row(e) << e, e + 1;
  const auto springs = make_term<2, 1>("springs", ends, [](Index, const auto& z) {
    const auto stretch = z(0, 1) - z(0, 0) - 1.0;
    return stretch * stretch;
  });
  Vec pull = Vec::Zero(kKnots);
  pull[0] = 1, pull[kKnots - 1] = -1;
  Cells first(1, 1);
  first << 0;
  const auto hold =
      make_term<1, 1>("hold", first, [](Index, const auto& z) { return z(0, 0) * z(0, 0); });
  const Problem problem =
      ProblemBuilder(kKnots).add(springs, 1).add(hold, 1).add(linear_term("pull", pull), 1).build();
  const SolveResult result = NewtonMinimizer().minimize(problem, Vec::Zero(kKnots), {});
  const Vec x = problem.expand(result.y);
  std::printf("%.12g\n", x[kKnots - 1] - x[0]);
  // 2 (stretch) = 1: every spring has length 1.5.
  const bool right = std::abs(x[kKnots - 1] - x[0] - 1.5 * (kKnots - 1)) < 1e-9;
  return result.status == Status::Converged && right ? 0 : 4;
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
