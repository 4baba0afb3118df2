#include "majorant/parametrization/atlas/internal/division.h"

#include <gtest/gtest.h>

#include <numbers>

#include "mesh/joined_meshes.h"
#include "mesh/surfaces_of_any_genus.h"
#include "parametrization/atlas/chart_sets.h"

namespace majorant {
namespace {

using test::HandMadeRun;

PolygonMesh half_ring() {
  return transformed(grid(10), [](const Vector3& p) -> Vector3 {
    const double angle = std::numbers::pi * p.x(), radius = 1 + 0.1 * p.y();
    return {-radius * std::cos(angle), radius * std::sin(angle), 0};
  });
}

PolygonMesh strip(double length) {
  return transformed(grid(12), [=](const Vector3& p) -> Vector3 {
    return {length * p.x(), p.y(), 0};
  });
}

// The box of a half ring is 2.2 by 1.1. One of the two parts spans 108 of the 180 degrees, and the
// cut is as long as the ring is wide.
TEST(Division, AHalfRingIsDividedAcross) {
  HandMadeRun ring(half_ring());
  ChartSet set = ring.projected();
  EXPECT_NEAR(area_of(box_of(set.pieces[0])), 2.2 * 1.1, 1e-9);
  const Division* const division = division_of(set, 0, ring.run);
  ASSERT_TRUE(division);
  EXPECT_NEAR(division->cost, 0.1, 1e-9);
  EXPECT_NEAR(division->price, 0.1 / (0.4 * ring.surface->area()), 1e-9);
  EXPECT_GT(division->saved_area, 1);
  EXPECT_NEAR(division->longest, 2.2 * std::sin(0.3 * std::numbers::pi), 1e-9);
  EXPECT_EQ(division_of(set, 0, ring.run), division);  // the result is cached
}

TEST(Division, MakesAsManyChartsAsAreRequested) {
  for (const Index count : {1, 2, 3, 5}) {
    HandMadeRun sheet(strip(3), {.least_charts = count});
    const ChartSet set = divide(sheet.projected(), sheet.run);
    EXPECT_EQ(set.pieces.size(), to_size(count));
    EXPECT_EQ(set.division, Status::Converged);
    test::expect_whole(set, *sheet.surface);
  }
}

TEST(Division, LeavesNoChartLargerThanIsAllowed) {
  HandMadeRun sheet(strip(3), {.max_chart_area = 0.8});
  const ChartSet set = divide(sheet.projected(), sheet.run);
  EXPECT_GE(set.pieces.size(), 4U);
  for (const ChartPiece& piece : set.pieces) EXPECT_LE(piece.mesh->area(), 0.8);
  EXPECT_EQ(set.division, Status::Converged);
  test::expect_whole(set, *sheet.surface);
}

TEST(Division, LongChartsAreHalved) {
  for (const double length : {1.0, 60.0}) {
    HandMadeRun sheet(strip(length));
    const ChartSet set = divide(sheet.projected(), sheet.run);
    EXPECT_EQ(set.pieces.size() > 1, length > 1) << length;
    test::expect_whole(set, *sheet.surface);
  }
}

TEST(Division, PinnedChartsStayWhole) {
  UnwrapOptions options{.least_charts = 3};
  options.chart.map.pins = {{0, Vector2(0, 0)}};
  HandMadeRun sheets(together(strip(1), moved(strip(1), {3, 0, 0})), options);
  const ChartSet set = divide(sheets.projected(), sheets.run);
  ASSERT_EQ(set.pieces.size(), 3U);
  EXPECT_EQ(set.pieces[0].mesh->face_count(), sheets.surface->face_count() / 2);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
