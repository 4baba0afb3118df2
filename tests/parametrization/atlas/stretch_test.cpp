#include "majorant/parametrization/atlas/stretch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "majorant/mesh/repair.h"
#include "mesh/test_meshes.h"

namespace majorant {
namespace {

TEST(Stretch, OfKnownMaps) {
  const std::shared_ptr<const SurfaceMesh> flat_grid = repair(grid(3)).mesh;
  const auto stretched = [&](double a, double b) {
    Vec uv(2 * flat_grid->vertex_count());
    for (Index v = 0; v < flat_grid->vertex_count(); ++v)
      uv.segment<2>(2 * v) << a * flat_grid->positions()(v, 0), b * flat_grid->positions()(v, 1);
    return measure_stretch(BezierMap::linear(flat_grid, uv));
  };
  EXPECT_NEAR(stretched(1, 1).l2, 1, 1e-14);
  EXPECT_NEAR(stretched(7, 7).max, 1, 1e-14);  // independent of scale
  // Singular values 1 and 1/4, area 4: (1 + 1/16) / 2 * 4.
  EXPECT_NEAR(stretched(1, 4).l2, std::sqrt(17.0 / 8), 1e-14);
  EXPECT_NEAR(stretched(1, 4).max, 2, 1e-14);
  // Two charts of different scale are stretched at a common scale.
  EXPECT_GT(stretched(1, 1).joined(stretched(2, 2)).l2, 1.1);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
