// A pendulum of springs is swung past 50 angles of its load: the derivative of the equilibrium by
// the load predicts the next one, exact Newton steps correct it. Two factorizations an angle at
// most.
#include "majorant/framework/newton.h"
#include "majorant/framework/sensitivity.h"
#include "majorant/framework/terms/local_term.h"
#include "outcome.h"
using namespace majorant;

int main() {
  // 1. A chain of nodes in the plane; the load's direction is data of a term.
  const Index count = 20;
  Cells pairs(count, 2), nodes(count, 1);
  for (Index e = 0; e < count; ++e) pairs.row(e) << e, e + 1, nodes(e, 0) = e + 1;
  const auto springs = make_term<2, 2>("springs", pairs, [](Index, const auto& z) {
    const auto stretch = (z.col(1) - z.col(0)).norm() - 1.0;
    return 50.0 * stretch * stretch;
  });
  const auto pull = [](double angle) { return Vec{{std::sin(angle), -std::cos(angle)}}; };
  const auto load = make_term<1, 2>(
      "load", nodes,
      [](Index, const auto& z, const auto& f) { return -(z(0, 0) * f[0] + z(1, 0) * f[1]); },
      pull(0));
  ProblemBuilder builder(2 * (count + 1));
  const TermId id = builder.add(springs, 1).add(load, 1);
  const Problem at_rest = builder.add(FixedPoints({{0, {0, 0}}})).build();
  // 2. The first equilibrium, from a chain that hangs down.
  Vec x(at_rest.full_size());
  for (Index k = 0; k <= count; ++k) x.segment<2>(2 * k) << 0, -k;
  NewtonOptions options;
  options.tests_minimum = false;
  SolveResult result = NewtonMinimizer(options).minimize(at_rest, at_rest.reduce(x), {});
  // 3. Predict, correct: the steps are exact from the first one on, for they begin near the end.
  options.curvature = Curvature::Exact;
  options.stopping.scale = EnergyScale::Value;
  options.stopping.decrement = 1e-9;
  const int steps = 50;
  const double step = 1.5 / steps;
  int factorizations = 0;
  for (int k = 0; k < steps && result.status == Status::Converged; ++k) {
    const Problem now = at_rest.with({{id, {.parameters = pull(k * step)}}});
    const Problem next = now.with({{id, {.parameters = pull((k + 1) * step)}}});
    const Sensitivity s(now, result, {.polishing_steps = 0});
    Sensitivity::Change change;
    change.parameters = {{id, pull((k + 1) * step) - pull(k * step)}};
    result =
        NewtonMinimizer(options).minimize(next, next.reduce(s.point() + s.forward(change)), {});
    ++factorizations;
    for (const IterationRecord& r : result.iterations) factorizations += r.factorizations;
  }
  // 4. The chain lies along its load.
  const Vec end = at_rest.expand(result.y).tail(2);
  return outcome(result, "the angle of the chain", std::atan2(end[0], -end[1]), 1.5,
                 factorizations <= 2 * steps ? 1e-6 : 0);
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
