#include "majorant/results/internal/map_job.h"

#include <gtest/gtest.h>

#include "mesh/surfaces_of_any_genus.h"

namespace majorant {
namespace {

// parametrize() has proven what must not overlap; the proof is made again only of a map that moved.
TEST(MapJob, TheBoundaryIsProvenOnce) {
  RunRecord record;
  MapJob job(MapTask::Parametrize, record);
  job.mesh = surface(grid(4, bumpy));
  job.options.map.degree = 1;
  job.options.map.injectivity = MapInjectivity::Global;
  job.solve();
  ASSERT_TRUE(job.result.boundary);
  EXPECT_EQ(job.result.boundary->result, ProofStatus::Proven);
  job.result.boundary->pairs_tested = -7;
  job.prove();
  EXPECT_EQ(job.boundary.pairs_tested, -7);
  ASSERT_TRUE(job.place(Turn::Free, true));
  job.prove();
  EXPECT_EQ(job.boundary.result, ProofStatus::Proven);
  EXPECT_GE(job.boundary.pairs_tested, 0);
  job.options.map.injectivity = MapInjectivity::Local;
  job.solve();
  EXPECT_FALSE(job.result.boundary);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
