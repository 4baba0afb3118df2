#include "majorant/parametrization/atlas/internal/chart_set.h"

#include <gtest/gtest.h>

#include "counted_stop.h"
#include "mesh/joined_meshes.h"
#include "parametrization/atlas/chart_sets.h"

namespace majorant {
namespace {

using test::HandMadeRun;

PolygonMesh three_sheets() {
  return together(together(grid(2), moved(grid(2), {3, 0, 0})), moved(grid(2), {6, 0, 0}));
}

TEST(ChartSet, ChartsGetTheOrderOfTheirFirstFaces) {
  HandMadeRun sheets(three_sheets());
  ChartSet set = sheets.projected();
  std::swap(set.pieces.front(), set.pieces.back());
  test::expect_whole(in_order(std::move(set)), *sheets.surface);
}

TEST(ChartSet, TheWorstChartGivesTheStatus) {
  HandMadeRun sheets(three_sheets());
  ChartSet set = sheets.projected();
  EXPECT_EQ(set.status(), Status::Converged);
  set.packed = Status::TimeLimit;
  EXPECT_EQ(set.status(), Status::TimeLimit);
  set.pieces[1].chart.status = Status::Infeasible;
  EXPECT_EQ(set.status(), Status::Infeasible);
}

// Charts without a map are counted and named after the run, not during it.
TEST(ChartSet, AStoppedRunTakesOutChartsWithoutAMap) {
  for (const bool is_stopped : {false, true}) {
    HandMadeRun sheets(three_sheets());
    ChartSet set = sheets.projected();
    set.pieces[1].chart.map.reset();
    EXPECT_TRUE(lacks_maps(set));
    RunRecord record(is_stopped ? CountedStop(1).check() : StopCheck());
    const UnwrapRun run(*sheets.surface, sheets.options, record);
    set = without_unmapped(std::move(set), run);
    EXPECT_EQ(set.is_complete(), !is_stopped);
    EXPECT_EQ(set.pieces.size(), is_stopped ? 2U : 3U);
    if (!is_stopped) continue;
    EXPECT_EQ(set.unmapped.count, 1);
    EXPECT_EQ(set.unmapped.faces, (std::vector<Index>{8, 9, 10, 11, 12, 13, 14, 15}));
    EXPECT_EQ(set.unmapped.status, Status::Interrupted);
    for (ChartPiece& piece : set.pieces) piece.chart.map.reset();
    EXPECT_THROW(without_unmapped(std::move(set), run), Stopped);
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
