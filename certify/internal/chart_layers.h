// Decides which charts of a layout may lie on each other, and proves that the others do not
// overlap.
#pragma once

#include <functional>
#include <vector>

#include "majorant/certify/global_injectivity.h"
#include "majorant/certify/stacked_charts.h"
#include "majorant/maps/bezier_map.h"

namespace majorant {

// Charts of different layers, and of one stack (StackedCharts), may overlap. The members' referents
// must outlive this.
struct ChartLayers {
  const std::vector<Index>& layer_of_cell;  // or empty: one layer
  const StackedCharts* stacks;              // may be null

  bool is_plain() const { return !stacks && layer_of_cell.empty(); }
  Index layer(Index cell) const { return layer_of_cell.empty() ? 0 : layer_of_cell[cell]; }
  // Returns whether the chart of a cell lies on another one.
  bool is_upper(Index cell) const {
    return stacks && !stacks->is_first[to_size(stacks->chart[cell])];
  }
};

// Returns the proof of the first layer that overlaps, else of the first undecided one, with the
// counts of all. plain: the map, cut wherever its sides differ. If the layers are not proven to be
// apart, copies of a vertex at one place are glued and the proof is repeated.
GlobalInjectivity overlaps_of(const BezierMap& plain, const ChartLayers& layers,
                              const std::function<bool()>& is_stopped);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
