// Energies in the trace of a run: every phase has the requested energy and the minimized one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "majorant/energies/energy_factory.h"
#include "majorant/parametrization/solve/parametrize_by.h"
#include "parametrization/solve/parametrize_expectations.h"

namespace majorant {
namespace {

std::vector<TraceEntry> trace_of(std::shared_ptr<const SurfaceMesh> mesh,
                                 const ParametrizationOptions& options,
                                 const SolverRules& rules = {}) {
  RunRecord record;
  const BezierMap start = BezierMap::linear(mesh, initial_map(*mesh, options.map));
  const ParametrizationResult result = parametrize_by(rules, start, options, record);
  double least = INFINITY;  // the result is the best map, which may not be the last
  for (const TraceEntry& row : record.trace()) least = std::min(least, row.energy);
  EXPECT_LE(result.value_quadrature, record.trace().back().energy);
  EXPECT_GE(result.value_quadrature, least);
  return record.trace();
}

// Expects that the first step on the requested energy, after steps on another one, begins at the
// map of an earlier row: of the last such step or, after a stall, of a row before it. Returns the
// number of such changes.
int expect_one_energy(const std::vector<TraceEntry>& trace, Phase other) {
  int changes = 0;
  for (std::size_t k = 0; k + 1 < trace.size(); ++k) {
    const TraceEntry &before = trace[k], &after = trace[k + 1];
    EXPECT_EQ(before.phase == Phase::Newton, before.energy == before.record.energy) << k;
    if (before.phase != other || after.phase != Phase::Newton) continue;
    const double began_at = after.energy / (1 - after.record.relative_decrease);
    EXPECT_TRUE(std::any_of(
        trace.begin(), trace.begin() + static_cast<long>(k) + 1,
        [&](const TraceEntry& row) { return std::abs(row.energy - began_at) <= 1e-8 * began_at; }))
        << k << ": " << before.energy << ", then from " << began_at;
    ++changes;
  }
  return changes;
}

TEST(Trace, SoftStartsRecordTheRequestedEnergy) {
  SolverRules rules;
  rules.soft_start = 6;
  const auto trace = trace_of(generated("ribbon"), degree(1), rules);
  EXPECT_EQ(trace.front().phase, Phase::SoftStart);
  EXPECT_EQ(expect_one_energy(trace, Phase::SoftStart), 1);
  EXPECT_LT(trace.front().record.energy, 0.9 * trace.front().energy);
}

TEST(Trace, EntriesRecordTheRequestedEnergy) {
  ParametrizationOptions options = degree(1);
  options.map.energy = {{find_energy("amips-exponential")->make, 2.0}};
  const auto trace = trace_of(generated("tube"), options);
  EXPECT_EQ(trace.front().phase, Phase::Entry);
  EXPECT_EQ(trace.front().energy, INFINITY);
  EXPECT_EQ(expect_one_energy(trace, Phase::Entry), 1);
}

TEST(Trace, BarriersAndExclusionsRecordTheRequestedEnergy) {
  ParametrizationOptions options = degree(1);
  options.map.energy = {{find_energy("arap")->make, 1.0}};
  options.map.boundary = BoundaryCondition::Fixed;
  const auto trace = trace_of(generated("tube"), options);
  EXPECT_GE(expect_one_energy(trace, Phase::Barrier), 1);
  EXPECT_GE(expect_one_energy(trace, Phase::Excluded), 1);
}

// The trace has the map's own energy, without the scaffold.
TEST(Trace, BarriersOfAScaffoldRecordTheRequestedEnergy) {
  ParametrizationOptions options = degree(2);
  options.map.energy = {{find_energy("arap")->make, 1.0}};
  options.map.injectivity = MapInjectivity::Global;
  SolverRules rules;
  rules.remedies.deepest_bisection = ProofDepth::kStart;
  rules.scaffold.depth = 0;  // makes a remedy necessary
  const auto trace = trace_of(surface(saddle_fan()), options, rules);
  EXPECT_GE(expect_one_energy(trace, Phase::Barrier), 1);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
