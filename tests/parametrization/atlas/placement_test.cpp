#include "majorant/parametrization/atlas/internal/placement.h"

#include <gtest/gtest.h>

#include "counted_stop.h"
#include "expected_error.h"
#include "mesh/joined_meshes.h"
#include "parametrization/atlas/chart_sets.h"

namespace majorant {
namespace {

using test::HandMadeRun;

PolygonMesh two_copies() { return together(grid(3), moved(grid(3), {3, 0, 0})); }

TEST(Placement, CopiesShareAPlaceWhereTheyAreStacked) {
  for (const Stacking stacking : {Stacking::None, Stacking::Equal}) {
    HandMadeRun sheets(two_copies(), {.stacking = stacking});
    const ChartSet set = place(sheets.projected(), sheets.run);
    ASSERT_TRUE(set.packing);
    EXPECT_EQ(set.packing->charts.size(), 2U);
    const auto& first = set.pieces[0].chart.map->control_points();
    const auto& second = set.pieces[1].chart.map->control_points();
    EXPECT_EQ(first == second, stacking == Stacking::Equal);
    EXPECT_EQ(set.pieces[1].chart.place.has_value(), stacking == Stacking::Equal);
    EXPECT_EQ(set.packing->charts[1].control_points(), second);
    for (const ChartPiece& piece : set.pieces) EXPECT_TRUE(piece.chart.measures.locally_injective);
  }
}

TEST(Placement, MirroredCopiesAreMirroredMaps) {
  HandMadeRun sheet(grid(2));
  const BezierMap map = *sheet.projected().pieces[0].chart.map;
  StackPlace place{.sense = ChartSense::Mirrored};
  for (Index f = 0; f < map.mesh().face_count(); ++f) {
    place.face.push_back(f);
    place.corner.push_back({0, 1, 2});
  }
  const BezierMap mirrored = map_on(map, map, place);
  for (Index v = 0; v < map.space().node_count(); ++v) {
    EXPECT_EQ(mirrored.control_points()[2 * v], -map.control_points()[2 * v]);
    EXPECT_EQ(mirrored.control_points()[2 * v + 1], map.control_points()[2 * v + 1]);
  }
}

TEST(Placement, AStoppedRunArrangesChartsQuickly) {
  HandMadeRun sheets(two_copies());
  ChartSet set = sheets.projected();
  RunRecord record(CountedStop(1).check());
  UnwrapRun stopped(*sheets.surface, sheets.options, record);
  EXPECT_THROW(place_smallest(set, stopped), Stopped);
  set = place(std::move(set), stopped);
  EXPECT_EQ(set.packed, Status::Interrupted);
  EXPECT_EQ(set.division, Status::Interrupted);
  ASSERT_TRUE(set.packing);
  EXPECT_EQ(set.packing->charts.size(), 2U);
}

TEST(Placement, PinnedChartsDoNotMeet) {
  for (const double x : {0.5, 2.0}) {
    UnwrapOptions options;
    options.chart.map.pins = {{0, Vector2(0, 0)}, {16, Vector2(x, 0)}};
    HandMadeRun sheets(two_copies(), options);
    const auto shifted = [=](const Vector3& p) -> Vector2 {
      return {p.x() < 2 ? p.x() : p.x() - 3 + x, p.y()};
    };
    ChartSet set = sheets.mapped(shifted);
    if (x < 1) {
      expect_contains(error_message(ErrorKind::Infeasible, [&] { place(set, sheets.run); }),
                      {"pinned vertices", "meet"});
      continue;
    }
    set = place(std::move(set), sheets.run);
    EXPECT_EQ(Vector2(set.pieces[1].chart.map->control_points().head<2>()), Vector2(x, 0));
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
