#include "majorant/parametrization/atlas/internal/fill.h"

#include <gtest/gtest.h>

#include "counted_stop.h"
#include "majorant/parametrization/atlas/internal/placement.h"
#include "mesh/surfaces_of_any_genus.h"
#include "parametrization/atlas/chart_sets.h"

namespace majorant {
namespace {

using test::HandMadeRun;

// Returns a planar L: two arms of this width.
PolygonMesh two_arms(int width) {
  constexpr int kLength = 20;
  std::set<int> removed;
  for (int j = width; j < kLength; ++j)
    for (int i = width; i < kLength; ++i) removed.insert(j * kLength + i);
  return grid_without(kLength, removed);
}

TEST(Fill, SeparatedArmsFillHalfOfTheSquare) {
  HandMadeRun arms(two_arms(4));
  const ChartSet placed = place(arms.projected(), arms.run);
  ASSERT_LT(placed.packing->fill, kLowFill);
  const ChartSet filled = fill(placed, arms.run);
  EXPECT_GE(filled.packing->fill, kUsualFill);
  EXPECT_GT(filled.pieces.size(), 1U);
  EXPECT_EQ(filled.packing->charts.size(), filled.pieces.size());
  EXPECT_LE(filled.cuts.length, kMoreSeam * 2);  // half of the border has the length of two sides
  test::expect_whole(filled, *arms.surface);
}

TEST(Fill, AFullEnoughLayoutStays) {
  for (const std::optional<double> least : {std::optional<double>(), std::optional<double>(0.5)}) {
    HandMadeRun sheet(grid(4), {.least_fill = least});
    const ChartSet placed = place(sheet.projected(), sheet.run);
    ASSERT_GT(placed.packing->fill, kUsualFill);
    const ChartSet filled = fill(placed, sheet.run);
    EXPECT_EQ(filled.pieces.size(), 1U);
    EXPECT_EQ(filled.cuts.length, 0);
  }
}

TEST(Fill, AFillOutOfReachEndsWithTheReason) {
  HandMadeRun arms(two_arms(4), {.least_fill = 0.999});
  const ChartSet placed = place(arms.projected(), arms.run);
  const ChartSet filled = fill(placed, arms.run);
  EXPECT_GT(filled.packing->fill, placed.packing->fill);
  EXPECT_EQ(filled.packing->charts.size(), filled.pieces.size());
  EXPECT_EQ(filled.division, Status::MaxIterations);
  test::expect_whole(filled, *arms.surface);
}

// Intermediate layouts may have a lower fill than earlier ones; none of these is returned.
TEST(Fill, AStopReturnsALayoutThatWasFinished) {
  for (const std::optional<double> least : {std::optional<double>(), std::optional<double>(0.7)}) {
    CountedStop never;
    HandMadeRun whole(two_arms(4), {.least_fill = least}, never.check());
    const ChartSet placed = place(whole.projected(), whole.run);
    const long first = never.polls();
    fill(placed, whole.run);
    for (long k = first + 1; k <= never.polls(); k += std::max(1L, (never.polls() - first) / 8)) {
      HandMadeRun arms(two_arms(4), {.least_fill = least}, CountedStop(k).check());
      const ChartSet filled = fill(place(arms.projected(), arms.run), arms.run);
      EXPECT_GE(filled.packing->fill, placed.packing->fill);
      EXPECT_EQ(filled.packing->charts.size(), filled.pieces.size());
      EXPECT_EQ(filled.division, least ? Status::Interrupted : Status::Converged);
      test::expect_whole(filled, *arms.surface);
    }
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
