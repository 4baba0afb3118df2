// Decides which charts of a layout may lie on each other, and whether the others overlap.
#pragma once

#include <functional>
#include <vector>

#include "majorant/certify/global_injectivity.h"
#include "majorant/certify/stacked_charts.h"
#include "majorant/maps/bezier_map.h"

namespace majorant {

// Charts of different layers may overlap, and those of one stack (StackedCharts). What it refers to
// outlives it.
struct ChartLayers {
  const std::vector<Index>& layer_of_cell;  // or empty: all cells are in one layer
  const StackedCharts* stacks;              // or null

  bool is_plain() const { return !stacks && layer_of_cell.empty(); }
  Index layer(Index cell) const { return layer_of_cell.empty() ? 0 : layer_of_cell[cell]; }
  // Returns whether the chart of a cell lies on another one.
  bool is_upper(Index cell) const {
    return stacks && !stacks->is_first[to_size(stacks->chart[cell])];
  }
};

// Judges the first layer that overlaps, else the first that is not decided; the counts are those of
// all layers. plain: the map, cut wherever its sides differ. Its copies of a vertex that lie at one
// place are glued where the layers are not proven to be apart without.
GlobalInjectivity overlaps_of(const BezierMap& plain, const ChartLayers& layers,
                              const std::function<bool()>& is_stopped);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
