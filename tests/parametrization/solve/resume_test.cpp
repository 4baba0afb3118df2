// A solver continues from the state of another solver at any step, to the same minimum.
#include "majorant/energies/energy_factory.h"
#include "majorant/framework/error.h"
#include "majorant/parametrization/initialization/start.h"
#include "majorant/parametrization/solve/degree_solver.h"
#include "majorant/parametrization/solve/normalized_start.h"
#include "parametrization/solve/parametrize_expectations.h"

namespace majorant {
namespace {

struct Kept {
  DegreeSolver::State state;
  Vec x;
};

class Resume {
 public:
  Resume(const char* mesh, const char* energy, int degree)
      : map_(BezierMap::linear(generated(mesh), tutte_map(*generated(mesh)))) {
    MapOptions requested;
    requested.energy = {{find_energy(energy)->make, 1.0}};
    const NormalizedStart start(map_, requested);
    map_ = start.map();
    while (map_.degree() < degree) map_ = map_.elevated();
    setup_ = {start.specification(), {}, {}, {}, {}, {}};
    setup_.solve.tolerance = 1e-9;  // results do not depend on paths
    setup_.watch = [this](const TraceEntry& row, const MapView& at) {
      const auto state = running_->state();
      EXPECT_TRUE(state || row.phase != Phase::SoftStart);
      if (state)
        kept_.push_back({*state, at.x});
      else
        ++without_;
      return Directive::Continue;
    };
  }

  SolveResult solve(const Kept* from = nullptr) {
    PlainDomain domain;
    DegreeSolver solver(setup_, domain, map_.shared_space(),
                        from ? from->x : map_.control_points());
    running_ = &solver;
    if (from) solver.resume(from->state);
    RunRecord record;
    solver.soft_start(record);
    const SolveResult result = solver.finish(record);
    last_ = solver.state();
    return result;
  }

  DegreeSolver::Setup setup_;
  BezierMap map_;
  std::vector<Kept> kept_;
  int without_ = 0;  // rows without a state
  std::optional<DegreeSolver::State> last_;
  const DegreeSolver* running_ = nullptr;
};

TEST(DegreeSolver, ResumesFromTheStateOfAnotherSolver) {
  Resume run("creature", "symmetric-dirichlet", 2);
  const SolveResult whole = run.solve();
  ASSERT_EQ(whole.status, Status::Converged) << whole.message;
  const std::vector<Kept> kept = std::exchange(run.kept_, {});
  ASSERT_GT(kept.size(), 5u);
  EXPECT_TRUE(run.last_.has_value());
  for (std::size_t k = 0; k < kept.size(); k += 3) {
    const SolveResult resumed = run.solve(&kept[k]);
    EXPECT_EQ(resumed.status, Status::Converged) << resumed.message;
    EXPECT_NEAR(resumed.energy, whole.energy, 1e-8 * whole.energy) << "from row " << k;
  }
  // The quadrature of the state at the end.
  const SolveResult again = run.solve(&kept.back());
  EXPECT_EQ(run.last_->levels, kept.back().state.levels);
  EXPECT_LE(again.iterations.size(), 3u);
}

TEST(DegreeSolver, LevelsMustBeThoseOfTheFaces) {
  Resume run("cap", "symmetric-dirichlet", 1);
  const auto faces = to_size(run.map_.mesh().face_count());
  Kept kept{{}, run.map_.control_points()};
  for (const std::vector<RuleId>& levels :
       {std::vector<RuleId>(faces - 1, 0), std::vector<RuleId>(faces, 99),
        std::vector<RuleId>(faces, -1)}) {
    kept.state.levels = levels;
    EXPECT_THROW(run.solve(&kept), InvalidArgument);
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
