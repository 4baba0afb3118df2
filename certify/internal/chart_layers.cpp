#include "majorant/certify/internal/chart_layers.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "majorant/certify/boundary_loops.h"
#include "majorant/certify/internal/glued_map.h"

namespace majorant {
namespace {

// Returns the layer of each cell; every chart that lies on another is a group of its own. Empty if
// all cells are in one layer.
std::vector<Index> layer_groups(const ChartLayers& layers, Index cells) {
  std::vector<Index> group;
  if (layers.is_plain()) return group;
  Index count = 0;
  for (const Index number : layers.layer_of_cell) count = std::max(count, number + 1);
  for (Index cell = 0; cell < cells; ++cell)
    group.push_back(layers.is_upper(cell) ? count + 1 + layers.stacks->chart[cell]
                                          : layers.layer(cell));
  return group;
}

// Returns the loops of each layer. Only one chart of a stack has loops.
std::map<Index, BoundaryLoops> loops_by_layer(const BoundaryLoops& all, const ChartLayers& layers) {
  std::map<Index, BoundaryLoops> result;
  std::map<Index, Index> number;  // number of a chart in its layer
  for (const BoundaryLoop& loop : all.loops) {
    const Index cell = face_of(all.half_edge[loop.first]);
    if (layers.is_upper(cell)) continue;
    BoundaryLoops& layer_loops = result[layers.layer(cell)];
    const auto [chart, is_new] = number.try_emplace(loop.chart, layer_loops.charts);
    layer_loops.charts += is_new;
    const auto first = static_cast<std::ptrdiff_t>(loop.first), last = std::ptrdiff_t{loop.last};
    layer_loops.add_loop(chart->second, {all.curves.begin() + first, all.curves.begin() + last},
                         {all.half_edge.begin() + first, all.half_edge.begin() + last});
  }
  return result;
}

// Returns the proof of the first layer that overlaps, else of the first undecided one, with the
// counts of all.
GlobalInjectivity worst_of_layers(const std::map<Index, BoundaryLoops>& layers,
                                  const InjectivityOptions& options) {
  const auto rank = [](ProofStatus s) {
    return s == ProofStatus::Violated ? 2 : s == ProofStatus::Undecided ? 1 : 0;
  };
  GlobalInjectivity worst, work;
  worst.result = ProofStatus::Proven;
  for (const auto& [unused, loops] : layers) {
    GlobalInjectivity proof = check_layout(loops, options);
    work.pairs_tested += proof.pairs_tested;
    work.pairs_left += proof.pairs_left;
    work.subdivisions += proof.subdivisions;
    if (rank(proof.result) > rank(worst.result)) worst = std::move(proof);
  }
  worst.pairs_tested = work.pairs_tested;
  worst.pairs_left = work.pairs_left;
  worst.subdivisions = work.subdivisions;
  return worst;
}

}  // namespace

GlobalInjectivity overlaps_of(const BezierMap& plain, const ChartLayers& layers,
                              const std::function<bool()>& is_stopped) {
  const InjectivityOptions options{.stopped = is_stopped};
  const auto check = [&](const BezierMap& map) {
    return layers.is_plain()
               ? check_boundary(map, options)
               : worst_of_layers(loops_by_layer(boundary_loops(map), layers), options);
  };
  GlobalInjectivity result = check(plain);
  if (result.result != ProofStatus::Proven)
    if (const std::optional<BezierMap> one =
            glued(plain, layer_groups(layers, plain.mesh().face_count())))
      result = check(*one);
  return result;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
