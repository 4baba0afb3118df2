// Charts bounded by sharp edges.
#include "majorant/parametrization/seams/internal/sharp_charts.h"

#include <algorithm>
#include <cmath>

#include "parametrization/seams/cut_checks.h"

namespace majorant {
namespace {

TEST(SharpCharts, AreTheSidesOfABox) {
  const SurfaceMesh box_surface = SurfaceMesh::from_polygons(voxel_surface(box(10, 10, 10)));
  const std::vector<char> flags = sharp_charts(box_surface, 40);
  EXPECT_EQ(std::count(flags.begin(), flags.end(), 1), 2 * 12 * 10);
  EXPECT_EQ(pieces_of(box_surface, flags).size(), 6u);
  EXPECT_EQ(std::count(flags.begin(), flags.end(), 0) + 2 * 12 * 10, box_surface.half_edge_count());
  const std::vector<char> none = sharp_charts(box_surface, 91);
  EXPECT_EQ(std::count(none.begin(), none.end(), 1), 0);
}

// A ridge whose angle decreases to 0 along it.
TEST(SharpCharts, CreasesThatEndEncloseNothing) {
  const auto ridge = [](double end) {
    return SurfaceMesh::from_polygons(grid(
        12, [end](double x, double y) { return -3 * std::abs(x - 0.5) * std::max(0.0, end - y); }));
  };
  const std::vector<char> ending = sharp_charts(ridge(0.5), 60), whole = sharp_charts(ridge(4), 60);
  EXPECT_EQ(std::count(ending.begin(), ending.end(), 1), 0);
  EXPECT_EQ(std::count(whole.begin(), whole.end(), 1), 2 * 12);
}

// 192 faces have two charts at most, none of a single face.
TEST(SharpCharts, AreFew) {
  const SurfaceMesh sphere = SurfaceMesh::from_polygons(cube_sphere(4));
  const std::vector<SurfaceMesh> charts = pieces_of(sphere, sharp_charts(sphere, 1));
  EXPECT_EQ(charts.size(), 2u);
  for (const SurfaceMesh& chart : charts) EXPECT_GT(chart.face_count(), 1);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
