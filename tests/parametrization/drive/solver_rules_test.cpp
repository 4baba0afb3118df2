// What parametrize_by() is told about its rules is what it goes by.
#include <algorithm>

#include "majorant/energies/named_energies.h"
#include "majorant/parametrization/drive/internal/parametrize_by.h"
#include "parametrization/drive/parametrize_expectations.h"

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

// Held back by certificates of the usual depth, see remedies_test.cpp.
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

TEST(SolverRules, AsDeepAsAllowed) {
  SolverRules rules;
  rules.remedies.deepest_bisection = ProofDepth::kStart;
  const RunByRules run = solve_cap(rules);
  EXPECT_EQ(run.result.remedies[static_cast<std::size_t>(Remedy::Deepen)].runs, 0);
}

TEST(SolverRules, ExactHessiansWhereAllowed) {
  SolverRules rules;
  EXPECT_TRUE(solve_cap(rules).uses_exact_hessians());
  rules.blend.below = 0;
  EXPECT_FALSE(solve_cap(rules).uses_exact_hessians());
}

}  // namespace
}  // namespace majorant
