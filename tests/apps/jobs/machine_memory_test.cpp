#include "majorant/apps/jobs/machine_memory.h"

#include <gtest/gtest.h>

#include "majorant/framework/linear_solver.h"
#include "majorant/parametrization/solve/parametrize.h"
#include "mesh/obj_file.h"

namespace majorant {
namespace {

TEST(SolverMemory, DirectWhereItFitsOrTakesLess) {
  struct Case {
    std::size_t direct, multigrid;
    std::optional<std::size_t> available;
    bool fits, multigrid_is_better;
  };
  for (const Case& c : {Case{100, 50, {}, true, false},   // unknown memory
                        Case{100, 50, 100, true, false},  // direct fits and is the fastest
                        Case{100, 50, 99, false, true},   // only multigrid fits
                        Case{100, 50, 10, false, true},   // none fits, and multigrid takes less
                        Case{50, 100, 10, false, false},  // none fits, and direct takes less
                        Case{100, 100, 10, false, false}}) {
    const SolverMemory memory{c.direct, c.multigrid, c.available};
    EXPECT_EQ(memory.fits_direct(), c.fits);
    EXPECT_EQ(memory.prefers_multigrid(), c.multigrid_is_better);
  }
}

// The predicted size of a degree's factor is the size in the run.
TEST(FactorSize, IsPredictedForADegree) {
  const auto mesh = generated("cap");
  for (const int degree : {2, 3}) {
    FactorSize met;
    ParametrizationOptions options;
    options.map.degree = degree;
    options.solve.linear_solver = [&](const SparsePattern& pattern,
                                      const DirectSolverOptions& direct) {
      auto solver = make_direct_solver(direct);
      solver->analyze(pattern);
      met = {solver->bytes(), pattern.rows.size()};
      return solver;
    };
    parametrize(mesh, options);
    const FactorSize foretold = factor_size(*mesh, degree);
    const FactorSize at_most = factor_size_at_most(*mesh, degree);
    EXPECT_NEAR(static_cast<double>(foretold.bytes), static_cast<double>(met.bytes),
                0.1 * static_cast<double>(met.bytes));
    EXPECT_NEAR(static_cast<double>(foretold.entries), static_cast<double>(met.entries),
                0.01 * static_cast<double>(met.entries));
    EXPECT_GE(at_most.bytes, met.bytes);
    EXPECT_GE(at_most.entries, met.entries);
  }
}

TEST(SolverMemory, IsEstimatedFromThePattern) {
  const FactorSize needed{7000000, 1000000};
  EXPECT_EQ(solver_memory(needed, 5u).direct, needed.bytes);
  EXPECT_EQ(solver_memory(needed, 5u).available, 5u);
  // Measured: with 157 entries per face, degree 3, cg-hypre takes 18 KB per face, plus 35 MB.
  const std::size_t little = solver_memory({}, {}).multigrid;
  EXPECT_NEAR(static_cast<double>(little), 35e6, 1e7);
  EXPECT_NEAR(static_cast<double>(solver_memory(needed, {}).multigrid - little), 115e6, 2e7);
  // The memory of the problem is not available to the factor.
  EXPECT_FALSE(foreseen_memory(needed, {}).available);
  EXPECT_EQ(foreseen_memory(needed, 5u).available, 0u);
  const std::size_t left = foreseen_memory(needed, 100000000u).available.value_or(0);
  EXPECT_NEAR(static_cast<double>(left), 67e6, 1e7);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
