// A hanging net takes the shape that is asked for: the lengths of its springs are found by L-BFGS
// from the derivative of the hanging net by all of them, one adjoint a step.
#include "majorant/framework/newton.h"
#include "majorant/framework/sensitivity.h"
#include "majorant/framework/terms/local_term.h"
#include "outcome.h"
using namespace majorant;

int main() {
  // 1. A net of n by n nodes, its rim held; every spring has a length of its own.
  const Index n = 10;
  Cells ends(2 * n * (n - 1), 2);
  Vec load = Vec::Zero(3 * n * n), x = load, depth = load;
  std::vector<FixedPoint3> held;
  for (Index k = 0, e = 0; k < n * n; ++k) {
    if (k % n + 1 < n) ends.row(e++) << k, k + 1;
    if (k / n + 1 < n) ends.row(e++) << k, k + n;
    x.segment<3>(3 * k) << k % n, k / n, 0;
    load[3 * k + 2] = 0.02;
    depth[3 * k + 2] = -0.002 * (k % n) * (k % n - n + 1) * (k / n) * (k / n - n + 1);
    if (depth[3 * k + 2] == 0) held.push_back({k, x.segment<3>(3 * k)});
  }
  const auto springs = [](Index, const auto& z, const auto& length) {
    const auto excess = (z.col(1) - z.col(0)).squaredNorm() / (length[0] * length[0]) - 1.0;
    return excess * excess;
  };
  Vec slope, next_slope, lengths = Vec::Constant(ends.rows(), 0.95);
  ProblemBuilder builder(x.size());
  const TermId id = builder.add(make_term<2, 3>("springs", ends, springs, RowMatrix(lengths)), 1);
  builder.add(linear_term("load", load), 1);
  const Problem net = builder.add(FixedPoints::in_space(held)).build();
  // 2. Half the square of what is missing, and its derivative by the lengths.
  SolveResult hanging;
  const auto misfit = [&](const Vec& at, Vec& by_lengths) {
    const Problem now = net.with({{id, {.parameters = at}}});
    hanging = NewtonMinimizer().minimize(now, net.reduce(x), nullptr);
    const Sensitivity s(now, hanging);
    const Vec away = (s.point() - depth).cwiseProduct(load) / 0.02;  // of heights alone
    by_lengths = s.adjoint(away).parameters[0];
    return away.squaredNorm() / 2;
  };
  // 3. L-BFGS, steps halved until the misfit falls.
  double value = misfit(lengths, slope), next = 0;
  std::vector<std::pair<Vec, Vec>> pairs;  // steps, changes of the slope over s . y
  for (int step = 0; step < 300 && value > 1e-7; ++step) {
    Vec p = -slope, a(step);
    for (Index k = step; k-- > 0; p -= a[k] * pairs[k].second)
      a[k] = pairs[k].first.dot(p) / pairs[k].first.dot(pairs[k].second);
    if (step > 0) p *= 0.5 * pairs[0].first.dot(pairs[0].second) / pairs[0].second.squaredNorm();
    for (Index k = 0; k < step; ++k)
      p += (a[k] - pairs[k].second.dot(p) / pairs[k].first.dot(pairs[k].second)) * pairs[k].first;
    while (!((next = misfit(lengths + p, next_slope)) < value)) p /= 2;
    pairs.emplace_back(p, next_slope - slope);
    lengths += p, value = next, slope = next_slope;
  }
  return outcome(hanging, "half the square of the misfit", value, 0, 1e-7);
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
