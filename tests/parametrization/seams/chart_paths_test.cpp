// Cheapest paths between points of the outline.
#include "majorant/parametrization/seams/internal/chart_paths.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "majorant/mesh/cut_graph.h"
#include "parametrization/seams/cut_checks.h"

namespace majorant {
namespace {

ChartPaths paths_of(const SurfaceMesh& mesh) {
  return ChartPaths(mesh, edge_lengths(mesh), longest_loop(mesh));
}

// Two rectangles in the plane, joined by a strip of 3 of 24 squares.
TEST(ChartPaths, BetweenEndsCrossTheNeck) {
  std::set<int> gone;
  for (int j = 8; j < 16; ++j)
    for (int i = 0; i < 24; ++i)
      if (i < 10 || i >= 13) gone.insert(j * 24 + i);
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(grid_without(24, gone));
  double least = 1;
  Index paths = 0;
  paths_of(mesh).find_between_ends({}, [&](const PathSearch& search, Index end) {
    least = std::min(least, search.distance[to_size(end)]);
    EXPECT_GE(search.entered[to_size(end)].first, 0);
    ++paths;
  });
  EXPECT_NEAR(least, 3.0 / 24, 1e-12);
  EXPECT_GT(paths, 2);
}

// From a corner of the square one path per window, none along the outline.
TEST(ChartPaths, AroundACornerReachAllOfTheOutline) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(grid(8));
  const ChartPaths paths = paths_of(mesh);
  const Index corner = 0;
  std::set<Index> windows;
  paths.find_around(corner, {}, [&](const PathSearch& search, Index end) {
    windows.insert(paths.steps(corner, end) * ChartPaths::kWindows / 32);
    for (Index v = end; search.entered[to_size(v)].first >= 0;) {
      const auto [before, h] = search.entered[to_size(v)];
      EXPECT_GE(mesh.opposite(h), 0);
      v = before;
    }
  });
  EXPECT_GE(windows.size(), 4u);
  EXPECT_EQ(paths.steps(corner, corner), 0);
  EXPECT_EQ(paths.steps(8, 0) + paths.steps(0, 8), 32);
}

// A ring: paths along its hole cost nothing.
TEST(ChartPaths, CostNothingAlongHoles) {
  std::set<int> hole;
  for (int j = 2; j < 8; ++j)
    for (int i = 2; i < 8; ++i) hole.insert(10 * j + i);
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(grid_without(10, hole));
  const ChartPaths paths = paths_of(mesh);
  Index left = -1, right = -1;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Vector3 p = mesh.positions().row(v);
    if ((p - Vector3(0, 0.5, 0)).norm() < 1e-12) left = v;
    if ((p - Vector3(1, 0.5, 0)).norm() < 1e-12) right = v;
  }
  EXPECT_NEAR(paths.all_from(left).distance[to_size(right)], 0.4, 1e-12);
  double across = 0;
  paths.find(
      {left}, [&](Index w) { return w == right; },
      [&](const PathSearch& search, Index end) { across = search.distance[to_size(end)]; });
  EXPECT_NEAR(across, 0.4, 1e-12);
}

// A fan of 400 degrees around its first vertex.
TEST(ChartPaths, AFullTurnAtACornerOverlaps) {
  std::vector<Vector3> positions{{0, 0, 0}};
  std::vector<std::vector<Index>> faces;
  for (int k = 0; k <= 8; ++k) {
    const double t = 50 * k * kPi / 180;
    positions.emplace_back(std::cos(t), std::sin(t), 0.01 * k);
    if (k > 0) faces.push_back({0, k, k + 1});
  }
  EXPECT_EQ(
      paths_of(SurfaceMesh::from_polygons(polygon_mesh(positions, faces))).overlapping_corner(), 0);
  EXPECT_EQ(paths_of(SurfaceMesh::from_polygons(grid(3))).overlapping_corner(), -1);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
