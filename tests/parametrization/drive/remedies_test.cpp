// Runs that stall at the limit of the feasible set, and the remedy that frees each of them.
#include <algorithm>

#include "majorant/energies/named_energies.h"
#include "parametrization/drive/parametrize_expectations.h"

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
  EXPECT_EQ(status_name(run.result.status), status_name(Status::Converged)) << run.result.message;
  return run;
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
  expect_unused(run, {Remedy::Deepen, Remedy::Refine, Remedy::Exclude, Remedy::FollowBarrier});
  EXPECT_EQ(run.steps(Phase::Newton), static_cast<long>(run.trace.size()));
}

TEST(Remedies, DeeperCertificatesFreeARun) {
  const RunWithTrace run = solve("cap", "log-isometric", 3, BoundaryCondition::Free);
  EXPECT_GE(run.use(Remedy::Deepen).runs, 1);
  EXPECT_GT(run.use(Remedy::Deepen).gained, 1e-3);
  EXPECT_EQ(run.marks(Remedy::Deepen), run.use(Remedy::Deepen).runs);
  expect_unused(run, {Remedy::Refine, Remedy::Exclude, Remedy::FollowBarrier});
}

TEST(Remedies, FinerQuadratureFreesARun) {
  const RunWithTrace run = solve("creature", "log-isometric", 2, BoundaryCondition::Fixed);
  EXPECT_GE(run.use(Remedy::Refine).runs, 1);
  EXPECT_GT(run.use(Remedy::Refine).gained, 1e-3);
  EXPECT_LT(run.use(Remedy::Deepen).gained, 1e-6) << "the certificate was not what held it back";
  expect_unused(run, {Remedy::Exclude, Remedy::FollowBarrier});
}

// Without a barrier of its own: what blocks is excluded, in vain or nearly so, then symmetric
// Dirichlet leads around.
TEST(Remedies, TheBarrierOfAnotherEnergyFreesARun) {
  const RunWithTrace run = solve("creature", "arap", 2, BoundaryCondition::Fixed);
  EXPECT_GE(run.use(Remedy::Exclude).runs, 1);
  EXPECT_GE(run.steps(Phase::Excluded), 1);
  EXPECT_GE(run.use(Remedy::FollowBarrier).runs, 1);
  EXPECT_GT(run.use(Remedy::FollowBarrier).gained, 0.1);
  EXPECT_EQ(run.marks(Remedy::FollowBarrier), run.use(Remedy::FollowBarrier).runs);
  EXPECT_GE(run.steps(Phase::Barrier), 6);
  // Marked, so that the trace of what was asked for is monotone but for returns to a better place.
  const TraceEntry& last = run.trace.back();
  EXPECT_EQ(phase_name(last.phase), "newton");
  EXPECT_NEAR(last.record.energy, run.result.value_quadrature, 1e-12);
}

}  // namespace
}  // namespace majorant
