// Effort::High: the lowest of the ends of several paths, at any moment of a stop.
#include "majorant/parametrization/solve/internal/several_paths.h"

#include <gtest/gtest.h>

#include <limits>

#include "counted_stop.h"
#include "majorant/maps/energy_text.h"
#include "maps/test_maps.h"
#include "mesh/test_meshes.h"

namespace majorant {
namespace {

ParametrizationOptions with_effort(Effort effort, int degree) {
  ParametrizationOptions options;
  options.map.degree = degree;
  options.solve.effort = effort;
  return options;
}

TEST(SeveralPaths, TheLowestEndIsTaken) {
  const auto mesh = surface(grid(6, bumpy));
  int calls = 0;
  // The third path claims the lowest energy, and its map is marked by its start.
  const SolveFromStart solve = [&](const ParametrizationOptions& options, RunRecord& record) {
    EXPECT_EQ(options.solve.effort, Effort::Normal);
    EXPECT_EQ(options.map.degree, 1);
    ParametrizationResult result = parametrize(mesh, options, record);
    if (++calls == 1) result.value_quadrature *= 1 + 1e-3;
    result.start = calls == 1 ? StartMethod::Multiresolution : StartMethod::Tutte;
    return result;
  };
  RunRecord record;
  const ParametrizationResult result =
      parametrize_on_paths({solve}, with_effort(Effort::High, 2), record);
  EXPECT_EQ(calls, 5);
  EXPECT_EQ(result.status, Status::Converged);
  EXPECT_EQ(result.start, StartMethod::Tutte);
  EXPECT_EQ(result.map->degree(), 2);
  EXPECT_GT(result.measures.min_det.minCoeff(), 0);
  RunRecord direct;
  const ParametrizationResult normal = parametrize(mesh, with_effort(Effort::Normal, 2), direct);
  EXPECT_NEAR(result.value_quadrature, normal.value_quadrature, 1e-6 * normal.value_quadrature);
}

TEST(SeveralPaths, PathsThatFailAreLeftOut) {
  const auto mesh = surface(grid(4, bumpy));
  int calls = 0;
  const SolveFromStart solve = [&](const ParametrizationOptions& options, RunRecord& record) {
    if (++calls == 2) throw Error(ErrorKind::Infeasible, "no start");
    ParametrizationResult result = parametrize(mesh, options, record);
    if (calls == 3) result.status = Status::Failed;
    return result;
  };
  RunRecord record;
  EXPECT_EQ(parametrize_on_paths({solve}, with_effort(Effort::High, 1), record).status,
            Status::Converged);
  EXPECT_EQ(calls, 5);
  const SolveFromStart none = [](const auto&, RunRecord&) -> ParametrizationResult {
    throw Error(ErrorKind::Infeasible, "no start");
  };
  EXPECT_THROW(parametrize_on_paths({none}, with_effort(Effort::High, 1), record), Error);
}

TEST(SeveralPaths, StopsLeaveTheLowestEndSoFar) {
  const auto mesh = surface(grid(5, bumpy));
  const CountedStop never;
  RunRecord whole(never.check());
  const double least = parametrize(mesh, with_effort(Effort::High, 1), whole).value_quadrature;
  const double start = parametrize(mesh, with_effort(Effort::Normal, 1)).initial_value;
  int results = 0;
  for (long k = 1; k <= never.polls(); k += std::max(1L, never.polls() / 40)) {
    SCOPED_TRACE(k);
    const CountedStop stop(k);
    RunRecord record(stop.check());
    try {
      const ParametrizationResult result = parametrize(mesh, with_effort(Effort::High, 1), record);
      ++results;
      EXPECT_TRUE(result.map);
      EXPECT_GT(result.measures.min_det.minCoeff(), 0);
      EXPECT_GE(result.value_quadrature, least * (1 - 1e-9));
      EXPECT_LE(result.value_quadrature, start * (1 + 1e-9));
    } catch (const Stopped& stopped) {
      EXPECT_EQ(stopped.why(), Directive::Interrupt);
    }
  }
  EXPECT_GT(results, 30);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
