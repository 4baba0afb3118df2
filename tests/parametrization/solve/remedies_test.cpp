// Runs that stall at the limit of the feasible set, and the remedy for each of them.
#include <algorithm>
#include <atomic>
#include <limits>

#include "majorant/certify/global_injectivity.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/parametrization/solve/parametrize_by.h"
#include "parametrization/solve/parametrize_expectations.h"

namespace majorant {
namespace {

struct RunWithTrace {
  ParametrizationResult result;
  std::vector<TraceEntry> trace;

  const RemedyUse& use(Remedy remedy) const {
    return result.remedies[static_cast<std::size_t>(remedy)];
  }
  long marks(Remedy remedy) const {
    return std::count_if(trace.begin(), trace.end(),
                         [&](const TraceEntry& e) { return e.remedy == remedy; });
  }
  long steps(Phase phase) const {
    return std::count_if(trace.begin(), trace.end(),
                         [&](const TraceEntry& e) { return e.phase == phase; });
  }
};

RunWithTrace solve(const char* mesh, const char* energy, int n, BoundaryCondition boundary) {
  ParametrizationOptions options = degree(n);
  options.map.energy = {{find_energy(energy)->make, 1.0}};
  options.map.boundary = boundary;
  RunRecord record;
  RunWithTrace run{parametrize(generated(mesh), options, record), {}};
  run.trace = record.trace();
  EXPECT_TRUE(run.result.measures.locally_injective);
  return run;
}

void expect_converged(const RunWithTrace& run) {
  EXPECT_EQ(status_name(run.result.status), status_name(Status::Converged)) << run.result.message;
}

void expect_unused(const RunWithTrace& run, std::initializer_list<Remedy> remedies) {
  for (const Remedy remedy : remedies) {
    EXPECT_EQ(run.use(remedy).runs, 0) << remedy_name(remedy);
    EXPECT_EQ(run.use(remedy).gained, 0) << remedy_name(remedy);
    EXPECT_EQ(run.marks(remedy), 0) << remedy_name(remedy);
  }
}

TEST(Remedies, NoneIsTriedWhereNothingHoldsARunBack) {
  const RunWithTrace run = solve("cap", "symmetric-dirichlet", 2, BoundaryCondition::Free);
  expect_converged(run);
  expect_unused(run, {Remedy::Deepen, Remedy::Refine, Remedy::Exclude, Remedy::FollowBarrier});
  EXPECT_EQ(run.steps(Phase::Newton), static_cast<long>(run.trace.size()));
}

TEST(Remedies, DeeperCertificatesFreeARun) {
  const RunWithTrace run = solve("cap", "log-isometric", 3, BoundaryCondition::Free);
  expect_converged(run);
  EXPECT_GE(run.use(Remedy::Deepen).runs, 1);
  EXPECT_GT(run.use(Remedy::Deepen).gained, 1e-3);
  EXPECT_EQ(run.marks(Remedy::Deepen), run.use(Remedy::Deepen).runs);
  expect_unused(run, {Remedy::Refine, Remedy::Exclude, Remedy::FollowBarrier});
}

TEST(Remedies, FinerQuadratureFreesARun) {
  const RunWithTrace run = solve("creature", "log-isometric", 2, BoundaryCondition::Fixed);
  expect_converged(run);
  EXPECT_GE(run.use(Remedy::Refine).runs, 1);
  EXPECT_GT(run.use(Remedy::Refine).gained, 1e-3);
  EXPECT_LT(run.use(Remedy::Deepen).gained, 1e-6) << "the certificate was not what held it back";
  expect_unused(run, {Remedy::Exclude, Remedy::FollowBarrier});
}

// An energy without barrier: excluding blocked directions gains little, then the path of the
// symmetric Dirichlet barrier avoids the limit.
TEST(Remedies, TheBarrierOfAnotherEnergyFreesARun) {
  const RunWithTrace run = solve("creature", "arap", 2, BoundaryCondition::Fixed);
  // The map stays at the limit of injectivity: the bound is on its energy, not on convergence.
  EXPECT_LT(run.result.measures.value, 0.6345);
  EXPECT_GE(run.use(Remedy::Exclude).runs, 1);
  EXPECT_GE(run.steps(Phase::Excluded), 1);
  EXPECT_GE(run.use(Remedy::FollowBarrier).runs, 1);
  EXPECT_GT(run.use(Remedy::FollowBarrier).gained, 0.1);
  EXPECT_EQ(run.marks(Remedy::FollowBarrier), run.use(Remedy::FollowBarrier).runs);
  EXPECT_GE(run.steps(Phase::Barrier), 6);
  // Barrier phases are marked. The trace of the requested energy is monotone except for returns to
  // a better map.
  const TraceEntry& last = run.trace.back();
  EXPECT_EQ(phase_name(last.phase), "newton");
  EXPECT_NEAR(last.record.energy, run.result.value_quadrature, 1e-12);
}

// ---- Bijective maps ----

ParametrizationOptions bijective_arap() {
  ParametrizationOptions options = degree(2);
  options.map.energy = {{find_energy("arap")->make, 1.0}};
  options.map.injectivity = MapInjectivity::Global;
  options.solve.scaffold = ScaffoldUse::FromTheStart;
  return options;
}

void expect_bijective(const ParametrizationResult& result) {
  ASSERT_TRUE(result.map && result.scaffold);
  EXPECT_TRUE(result.measures.locally_injective);
  EXPECT_EQ(check_boundary(*result.map).result, ProofStatus::Proven);
}

// Either the scaffold's certificate is no deeper than the map's, or no remedy is needed.
TEST(Remedies, FreeBijectiveRuns) {
  SolverRules rules;
  rules.scaffold.depth = 0;
  const auto mesh = surface(saddle_fan());
  const ParametrizationOptions options = bijective_arap();
  const BezierMap start = BezierMap::linear(mesh, initial_map(*mesh, options.map));
  RunRecord record;
  const RunWithTrace run{parametrize_by(rules, start, options, record), record.trace()};
  EXPECT_EQ(status_name(run.result.status), status_name(Status::Converged)) << run.result.message;
  EXPECT_EQ(run.use(Remedy::Deepen).runs, 1);
  EXPECT_GT(run.use(Remedy::Deepen).gained, 1e-4);
  EXPECT_EQ(run.marks(Remedy::Deepen), 1);
  expect_unused(run, {Remedy::Refine, Remedy::Exclude, Remedy::FollowBarrier});
  expect_bijective(run.result);
}

// Without deeper certificates, only the path along barriers remains. A stop on it restores map and
// scaffold at its beginning, which is the end of a run without remedies.
class StoppedOnTheWay : public testing::TestWithParam<int> {
 protected:
  // Stopped by iteration `last` of the barrier phase.
  static RunWithTrace run(const SolverRules& rules, int last) {
    std::atomic<bool> interrupt{false};
    int steps = 0;
    StepObserver observer([&](const TraceEntry& row, const Vec&) {
      if (row.phase == Phase::Barrier && ++steps == last) interrupt = true;
      return Directive::Continue;
    });
    RunRecord record(std::numeric_limits<double>::infinity(), std::numeric_limits<int>::max(),
                     &interrupt, &observer);
    const auto mesh = surface(saddle_fan());
    const ParametrizationOptions options = bijective_arap();
    const BezierMap start = BezierMap::linear(mesh, initial_map(*mesh, options.map));
    RunWithTrace run{parametrize_by(rules, start, options, record), {}};
    run.trace = record.trace();
    return run;
  }
};

TEST_P(StoppedOnTheWay, IsWhereItBegan) {
  SolverRules rules;
  rules.remedies.deepest_bisection = ProofDepth::kStart;
  rules.scaffold.depth = 0;
  const RunWithTrace stopped = run(rules, GetParam());
  EXPECT_EQ(status_name(stopped.result.status), status_name(Status::Interrupted));
  EXPECT_EQ(stopped.steps(Phase::Barrier), GetParam());
  expect_bijective(stopped.result);

  rules.remedies.stall_rounds = 0;
  const RunWithTrace before = run(rules, 0);
  EXPECT_EQ(status_name(before.result.status), status_name(Status::Stalled));
  EXPECT_EQ(stopped.result.map->control_points(), before.result.map->control_points());
  EXPECT_EQ(stopped.result.value_quadrature, before.result.value_quadrature);
  EXPECT_EQ(stopped.result.scaffold->points, before.result.scaffold->points);
}

INSTANTIATE_TEST_SUITE_P(Steps, StoppedOnTheWay, testing::Values(1, 2, 4));

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
