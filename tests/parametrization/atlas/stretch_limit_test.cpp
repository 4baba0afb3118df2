#include "majorant/parametrization/atlas/internal/stretch_limit.h"

#include <gtest/gtest.h>

#include "counted_stop.h"
#include "majorant/parametrization/atlas/internal/chart_cutting.h"
#include "mesh/joined_meshes.h"
#include "mesh/surfaces_of_any_genus.h"
#include "parametrization/atlas/chart_sets.h"

namespace majorant {
namespace {

using test::HandMadeRun;

// Returns a flat sheet and a curved one that has no map within the limit in one piece.
PolygonMesh flat_and_bumpy() {
  const auto high = [](double x, double y) { return 4 * bumpy(x, y); };
  return together(grid(3), moved(grid(6, high), {3, 0, 0}));
}

TEST(StretchLimit, ChartsThatExceedItAreCut) {
  HandMadeRun sheets(flat_and_bumpy());
  const ChartSet before = sheets.projected();
  ASSERT_FALSE(exceeds_stretch(sheets.options, before.pieces[0].chart));
  ASSERT_TRUE(exceeds_stretch(sheets.options, before.pieces[1].chart));
  const ChartSet after = limit_stretch(before, sheets.run);
  test::expect_whole(after, *sheets.surface);
  for (const ChartPiece& piece : after.pieces)
    EXPECT_FALSE(exceeds_stretch(sheets.options, piece.chart));
  EXPECT_GT(after.cuts.length, 0);
  EXPECT_EQ(after.pieces[0].chart.map->control_points(),
            before.pieces[0].chart.map->control_points());
}

TEST(StretchLimit, ALimitThatIsOnlyReportedCutsNothing) {
  HandMadeRun sheets(flat_and_bumpy(), {.limit = StretchLimit::Reported});
  const ChartSet set = limit_stretch(sheets.projected(), sheets.run);
  EXPECT_EQ(set.pieces.size(), 2U);
  EXPECT_EQ(set.cuts.length, 0);
}

// A flat ring that is cut open: both sides of the cut coincide in the plane.
TEST(StretchLimit, CutsWithMatchingSidesAreClosed) {
  HandMadeRun ring(grid_without(3, {4}));
  const SurfaceMesh& surface = *ring.surface;
  SurfaceCuts cuts = choose_cuts(surface, {.method = CutMethod::Given});
  std::vector<Index> across;  // the edges from the hole to the border, along y = 1/3
  for (Index h = 0; h < surface.half_edge_count(); ++h) {
    const Vector3 a = surface.positions().row(surface.from_vertex(h));
    const Vector3 b = surface.positions().row(surface.to_vertex(h));
    const Vector3 middle = 0.5 * (a + b);
    if (surface.opposite(h) >= 0 && std::abs(middle.y() - 1.0 / 3) < 1e-9 &&
        std::abs(a.y() - b.y()) < 1e-9 && middle.x() < 1.0 / 3)
      across.push_back(h);
  }
  ASSERT_EQ(across.size(), 2U);
  add_cuts(surface, ring.options.cuts, across, cuts);
  EXPECT_NEAR(cuts.length, 1.0 / 3, 1e-12);
  ChartSet set = charts_along(std::move(cuts), ring.run);
  ASSERT_EQ(set.pieces.size(), 1U);
  ASSERT_EQ(set.pieces[0].mesh->topology().boundary_loops, 1);
  set = limit_stretch(solve(std::move(set), ring.run), ring.run);
  ASSERT_EQ(set.pieces.size(), 1U);
  EXPECT_EQ(set.pieces[0].mesh->topology().boundary_loops, 2);
  EXPECT_EQ(set.cuts.length, 0);
  EXPECT_EQ(set.pieces[0].chart.status, Status::Converged);
}

// After a stop at any moment, charts that had maps have maps: unfinished cuts are undone.
TEST(StretchLimit, AStopLeavesNoChartWithoutItsMap) {
  CountedStop never;
  long first = 0;
  {
    HandMadeRun whole(flat_and_bumpy(), {}, never.check());
    ChartSet set = whole.projected();
    first = never.polls();
    limit_stretch(std::move(set), whole.run);
  }
  int stopped = 0;
  for (long k = first + 1; k <= never.polls(); k += std::max(1L, (never.polls() - first) / 50)) {
    HandMadeRun sheets(flat_and_bumpy(), {}, CountedStop(k).check());
    const ChartSet set = limit_stretch(sheets.projected(), sheets.run);
    test::expect_whole(set, *sheets.surface);
    stopped += set.pieces[1].chart.status == Status::Interrupted;
  }
  EXPECT_GT(stopped, 0);
}

// Undoing a cut restores the charts that it replaces.
TEST(ChartCutting, AStopRestoresTheCharts) {
  const auto cut_both = [](const ChartSet& set, const StopCheck& stop) {
    std::vector<HalfEdgeFlags> cuts;
    for (const ChartPiece& piece : set.pieces)
      cuts.push_back(cut_in_two(*piece.mesh, piece.preferences, PartsAround::Planes, stop));
    return cuts;
  };
  CountedStop never;
  HandMadeRun whole(flat_and_bumpy(), {}, never.check());
  const ChartSet before = whole.projected();
  const long first = never.polls();
  const Recut cut = cut_and_solve(before, {0, 1}, cut_both, whole.run);
  EXPECT_TRUE(cut.is_complete);
  EXPECT_EQ(cut.set.pieces.size(), 4U);
  for (long k = first + 1; k <= never.polls(); k += std::max(1L, (never.polls() - first) / 20)) {
    HandMadeRun sheets(flat_and_bumpy(), {}, CountedStop(k).check());
    const Recut recut = cut_and_solve(sheets.projected(), {0, 1}, cut_both, sheets.run);
    if (recut.is_complete) continue;
    test::expect_whole(recut.set, *sheets.surface);
    EXPECT_EQ(recut.set.cuts.is_cut, before.cuts.is_cut);
    ASSERT_EQ(recut.set.pieces.size(), 2U);
    for (const std::size_t i : {0, 1})
      EXPECT_EQ(recut.set.pieces[i].chart.map->control_points(),
                before.pieces[i].chart.map->control_points());
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
