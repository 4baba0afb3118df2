#include "majorant/results/internal/finished_map.h"

#include <gtest/gtest.h>

#include "mesh/surfaces_of_any_genus.h"

namespace majorant {
namespace {

// parametrize() has proven what must not overlap; the proof is made again only of a map that moved.
TEST(FinishedMap, TheBoundaryIsProvenOnce) {
  ParametrizationOptions options;
  options.map.degree = 1;
  options.map.injectivity = MapInjectivity::Global;
  ParametrizationResult result = parametrize(surface(grid(4, bumpy)), options);
  ASSERT_TRUE(result.boundary);
  EXPECT_EQ(result.boundary->result, ProofStatus::Proven);
  result.boundary->pairs_tested = -7;
  const RunRecord record;
  EXPECT_EQ(prove_boundary(result, record).pairs_tested, -7);
  result.boundary.reset();
  const GlobalInjectivity again = prove_boundary(result, record);
  EXPECT_EQ(again.result, ProofStatus::Proven);
  EXPECT_GE(again.pairs_tested, 0);
  options.map.injectivity = MapInjectivity::Local;
  EXPECT_FALSE(parametrize(surface(grid(4, bumpy)), options).boundary);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
