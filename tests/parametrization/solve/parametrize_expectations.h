// Properties of every result of parametrize(), and a surface whose maps tend to overlap.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>

#ifndef MAJORANT_NO_GPL
#include "majorant/framework/cholmod_solver.h"
#endif
#include "majorant/parametrization/solve/parametrize.h"
#include "maps/test_maps.h"
#include "mesh/test_meshes.h"

namespace majorant {

#ifndef MAJORANT_NO_GPL
inline std::unique_ptr<LinearSolver> cholmod_solver(const SparsePattern&,
                                                    const DirectSolverOptions& direct) {
  return make_cholmod_solver({direct.ordering});
}
#endif

// Uses CHOLMOD if the environment has MAJORANT_TEST_CHOLMOD: the tests *_on_cholmod.
inline ParametrizationOptions degree(int n) {
  ParametrizationOptions options;
  options.map.degree = n;
#ifndef MAJORANT_NO_GPL
  if (std::getenv("MAJORANT_TEST_CHOLMOD")) options.solve.linear_solver = cholmod_solver;
#endif
  return options;
}

// Returns a fan, cut along one edge, whose cone angle is far above 2 pi: with a free boundary the
// two sides of the cut overlap.
inline PolygonMesh saddle_fan() {
  constexpr int n = 16;
  std::vector<Vector3> positions{{0, 0, 0}};
  for (int k = 0; k <= n; ++k) {
    const double t = 2 * kPi * k / n;
    positions.push_back({std::cos(t), std::sin(t), 1.2 * std::sin(3 * t)});
  }
  for (int k = 0; k <= n; ++k) positions.push_back(2 * positions[1 + k]);
  std::vector<std::vector<Index>> faces;
  for (int k = 0; k < n; ++k) {
    const Index a = 1 + k, b = a + 1, c = n + 2 + k, d = c + 1;
    faces.push_back({0, a, b});
    faces.push_back({a, c, d});
    faces.push_back({a, d, b});
  }
  return polygon_mesh(std::move(positions), std::move(faces));
}

// Expects the properties of every result, converged or not.
inline void expect_valid(const ParametrizationResult& result, int n) {
  ASSERT_TRUE(result.map.has_value());
  EXPECT_EQ(result.map->degree(), n);
  EXPECT_TRUE(result.map->control_points().allFinite());
  EXPECT_TRUE(result.measures.locally_injective);
  EXPECT_GT(result.measures.min_det.minCoeff(), 0);
  EXPECT_GE(result.measures.value, 4 - 1e-12);
  EXPECT_LE(result.constraint_residual, 1e-12 * result.map->control_points().cwiseAbs().maxCoeff());
}

// Returns the elevated start along the boundary, in the doubles that the solver fixes.
inline void expect_boundary_fixed(const ParametrizationResult& result, const Vec& start) {
  const BezierMap initial =
      elevated_to(BezierMap::linear(result.map->shared_mesh(), start), result.map->degree());
  const double size = start.cwiseAbs().maxCoeff();
  for (const Index node : result.map->space().boundary_nodes())
    EXPECT_LE((result.map->control_points().segment<2>(2 * node) -
               initial.control_points().segment<2>(2 * node))
                  .norm(),
              1e-14 * size)
        << "node " << node;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
