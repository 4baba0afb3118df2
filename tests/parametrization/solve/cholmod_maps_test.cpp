// Maps by CHOLMOD and by the library's own factorization take equal paths up to rounding.
#include <cmath>

#include "majorant/parametrization/initialization/start.h"
#include "parametrization/fields/closed_surfaces.h"
#include "parametrization/solve/parametrize_expectations.h"

namespace majorant {
namespace {

// Both runs with the options of either solver.
void expect_same(const BezierMap& start, ParametrizationOptions options) {
  options.solve.linear_solver = {};
  RunRecord own_record, record;
  const ParametrizationResult own = parametrize(start, options, own_record);
  options.solve.linear_solver = cholmod_solver;
  const ParametrizationResult result = parametrize(start, options, record);
  EXPECT_EQ(result.status, own.status);
  ASSERT_TRUE(result.map && own.map);
  EXPECT_TRUE(result.measures.locally_injective);
  EXPECT_EQ(record.trace().size(), own_record.trace().size());
  EXPECT_NEAR(result.measures.value, own.measures.value, 1e-9 * own.measures.value);
}

class ByCholmod : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(All, ByCholmod, testing::Values("cap", "ribbon", "tube", "wavy_disk"));

TEST_P(ByCholmod, TheSameMaps) {
  const auto mesh = generated(GetParam());
  for (const int n : {1, 2, 3})
    for (const auto boundary : {BoundaryCondition::Free, BoundaryCondition::Fixed}) {
      SCOPED_TRACE(testing::Message() << n << (boundary == BoundaryCondition::Free ? " free" : ""));
      ParametrizationOptions options = degree(n);
      options.map.boundary = boundary;
      expect_same(BezierMap::linear(mesh, initial_map(*mesh, options.map)), options);
    }
}

TEST_P(ByCholmod, TheSameInAScaffold) {
  const auto mesh = generated(GetParam());
  ParametrizationOptions options = degree(2);
  options.map.injectivity = MapInjectivity::Global;
  expect_same(BezierMap::linear(mesh, initial_map(*mesh, options.map)), options);
}

TEST(ByCholmod, TheSameSeamlessMap) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(cube(6));
  RunRecord record;
  const Start start = make_seamless(mesh, {}, record);
  expect_same(start.map, degree(2));
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
