// parametrize_by() uses the given rules.
#include <algorithm>
#include <utility>

#include "majorant/energies/energy_factory.h"
#include "majorant/parametrization/solve/parametrize_by.h"
#include "parametrization/solve/parametrize_expectations.h"

namespace majorant {
namespace {

struct RunByRules {
  ParametrizationResult result;
  std::vector<TraceEntry> trace;

  int remedies() const {
    int runs = 0;
    for (const RemedyUse& use : result.remedies) runs += use.runs;
    return runs;
  }
  bool uses_exact_hessians() const {
    return std::any_of(trace.begin(), trace.end(),
                       [](const TraceEntry& e) { return e.record.curvature == Curvature::Exact; });
  }
};

// The usual certificate depth limits its steps, see remedies_test.cpp.
RunByRules solve_cap(const SolverRules& rules) {
  ParametrizationOptions options = degree(3);
  options.map.energy = {{find_energy("log-isometric")->make, 1.0}};
  const auto mesh = generated("cap");
  RunRecord record;
  const BezierMap start = BezierMap::linear(mesh, initial_map(*mesh, options.map));
  RunByRules run{parametrize_by(rules, start, options, record), {}};
  run.trace = record.trace();
  return run;
}

TEST(SolverRules, WithoutRemediesARunStaysWhereItStalls) {
  SolverRules rules;
  rules.remedies.stall_rounds = 0;
  const RunByRules run = solve_cap(rules);
  EXPECT_EQ(status_name(run.result.status), status_name(Status::Stalled));
  EXPECT_EQ(run.remedies(), 0);
}

TEST(SolverRules, ProofsAreAsDeepAsAllowed) {
  SolverRules rules;
  rules.remedies.deepest_bisection = ProofDepth::kStart;
  const RunByRules run = solve_cap(rules);
  EXPECT_EQ(run.result.remedies[static_cast<std::size_t>(Remedy::Deepen)].runs, 0);
}

// A solver is made for the Hessian pattern of each degree, and used.
TEST(SolveOptions, LinearSolverIsMadeForEveryDegree) {
  const auto mesh = generated("cap");
  for (const auto injectivity : {MapInjectivity::Local, MapInjectivity::Global}) {
    ParametrizationOptions options = degree(3);
    options.map.injectivity = injectivity;
    options.solve.scaffold = ScaffoldUse::FromTheStart;
    const double value = parametrize(mesh, options).measures.value;
    std::vector<Index> sizes;
    options.solve.linear_solver = [&](const SparsePattern& pattern,
                                      const DirectSolverOptions& direct) {
      sizes.push_back(pattern.size);
      EXPECT_EQ(direct.ordering == Ordering::Amd, injectivity == MapInjectivity::Global);
      return make_direct_solver(direct);
    };
    EXPECT_EQ(parametrize(mesh, options).measures.value, value);
    ASSERT_EQ(sizes.size(), 3u);
    EXPECT_LT(sizes[0], sizes[1]);
    EXPECT_LT(sizes[1], sizes[2]);
  }
}

// A scaffold with patience is updated less often, and the run has the same minimum.
TEST(SolverRules, ScaffoldsOfLargeMapsAreUpdatedLessOften) {
  ParametrizationOptions options = degree(1);
  options.map.injectivity = MapInjectivity::Global;
  options.solve.scaffold = ScaffoldUse::FromTheStart;
  const auto mesh = generated("creature");
  const BezierMap start = BezierMap::linear(mesh, initial_map(*mesh, options.map));
  SolverRules waiting;
  waiting.lagged.below = 1;  // so that small maps reuse factors
  waiting.scaffold.patient_faces = mesh->face_count();
  SolverRules rules = waiting;
  rules.scaffold.patience = 0;
  RunRecord usual_record, record;
  const ParametrizationResult usual = parametrize_by(rules, start, options, usual_record);
  const ParametrizationResult result = parametrize_by(waiting, start, options, record);
  EXPECT_EQ(result.status, Status::Converged) << result.message;
  EXPECT_LT(result.flips.intended, usual.flips.intended);
  EXPECT_NEAR(result.measures.value, usual.measures.value, 5e-6 * usual.measures.value);
}

TEST(SolverRules, ExactHessiansAreUsedIfAllowed) {
  SolverRules rules;
  EXPECT_TRUE(solve_cap(rules).uses_exact_hessians());
  rules.blend.below = 0;
  EXPECT_FALSE(solve_cap(rules).uses_exact_hessians());
}

// With a scaffold Hessians never become exact, so that a second small step is useless.
TEST(SolverRules, InAScaffoldTheFirstSmallStepEndsARun) {
  ParametrizationOptions options = degree(1);
  options.map.injectivity = MapInjectivity::Global;
  options.solve.scaffold = ScaffoldUse::FromTheStart;
  const auto mesh = generated("cap");
  const BezierMap start = BezierMap::linear(mesh, initial_map(*mesh, options.map));
  const auto solve = [&](int tail_steps) {
    SolverRules rules;
    rules.scaffold.tail_steps = tail_steps;
    RunRecord record;
    const ParametrizationResult result = parametrize_by(rules, start, options, record);
    EXPECT_EQ(status_name(result.status), status_name(Status::Converged));
    return std::pair(record.trace().size(), result.measures.value);
  };
  EXPECT_EQ(SolverRules().scaffold.tail_steps, 1);
  const auto [one, energy] = solve(1);
  const auto [three, least] = solve(3);
  EXPECT_GE(three, one + 2);
  EXPECT_LE(energy, (1 + 1e-6) * least);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
