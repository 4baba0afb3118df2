// A net of springs, held at its corners, sags under its weight: a rest length for each spring, a
// load for each knot. The corners carry the whole weight.
#include "majorant/framework/newton.h"
#include "majorant/framework/terms/local_term.h"
#include "meshes.h"
#include "outcome.h"
using namespace majorant;

int main() {
  // 1. The rest length of each spring, a little less than the net has; the weight of each knot.
  const ExampleMesh net = square(10);
  const Cells ends = edges_of(net.cells);
  Vec rest(ends.rows()), weight = Vec::Zero(net.points.size()), forces;
  for (Index e = 0; e < rest.size(); ++e)
    rest[e] = 0.95 * (net.points.row(ends(e, 0)) - net.points.row(ends(e, 1))).norm();
  for (Index k = 2; k < weight.size(); k += 3) weight[k] = 0.01;
  const auto springs = make_term<2, 3>("springs", ends, [rest](Index e, const auto& z) {
    const auto stretch = (z.col(1) - z.col(0)).norm() - rest[e];
    return stretch * stretch / rest[e];
  });
  // 2. The loose net, the held one, and a start that is not flat: that could not tell up from down.
  ProblemBuilder builder(static_cast<Index>(weight.size()));
  const Problem loose = builder.add(springs, 1).add(linear_term("weight", weight), 1).build();
  const Problem problem = builder.add(held(net.points, {0, 10, 110, 120})).build();
  const Vec start = problem.reduce(unknowns_of(net.points) - weight);
  // 3. The forces that hold the corners are the gradient there.
  const SolveResult result = NewtonMinimizer().minimize(problem, start, {});
  Evaluator(loose).gradient(problem.expand(result.y), forces);
  const double carried = forces[2] + forces[3 * 10 + 2] + forces[3 * 110 + 2] + forces[3 * 120 + 2];
  return outcome(result, "the corners carry", carried, weight.sum(), 1e-5);
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
