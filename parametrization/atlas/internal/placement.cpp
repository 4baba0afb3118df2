#include "majorant/parametrization/atlas/internal/placement.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "majorant/certify/proven_distance.h"
#include "majorant/elements/bernstein.h"
#include "majorant/framework/error.h"
#include "majorant/framework/stopwatch.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/parametrization/atlas/internal/chart_maps.h"

namespace majorant {
namespace {

// The smallest distance of pinned charts, in square roots of a chart's area. It is a billion
// rounding errors.
constexpr double kPinnedGap = 1e-7;

// Refuses charts that pins put on top of each other.
void require_pinned_apart(const ChartSet& set, const UnwrapRun& run) {
  std::vector<const Chart*> pinned;
  for (const ChartPiece& piece : set.pieces)
    if (!piece.chart.pins.empty()) pinned.push_back(&piece.chart);
  for (std::size_t i = 0; i < pinned.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const BezierMap &a = *pinned[j]->map, &b = *pinned[i]->map;
      const double gap = kPinnedGap * std::sqrt(pinned[i]->stretch.image_area);
      if (proven_distance({a, b}, gap) > 0) continue;
      const auto name = [](const Chart& chart) {
        return chart.map->mesh().input_vertex(chart.pins.front().vertex);
      };
      throw Error(ErrorKind::Infeasible,
                  fmt::format("{}the charts of the pinned vertices {} and {} meet; move their "
                              "targets apart",
                              message_prefix(run.surface), name(*pinned[j]), name(*pinned[i])));
    }
}

// Returns for each chart the one that it is stacked on. Held charts are never stacked.
std::vector<std::optional<StackPlace>> stacks_of(const ChartSet& set,
                                                 const UnwrapOptions& options) {
  std::vector<std::size_t> loose;
  std::vector<std::shared_ptr<const SurfaceMesh>> surfaces;
  std::vector<double> scale;
  for (std::size_t k = 0; k < set.pieces.size(); ++k) {
    const ChartPiece& piece = set.pieces[k];
    if (is_held(piece)) continue;
    loose.push_back(k);
    surfaces.push_back(piece.mesh);
    if (options.face_scale.size() > 0) scale.push_back(options.face_scale[piece.faces.front()]);
  }
  std::vector<std::optional<StackPlace>> places = stack_places(surfaces, options.stacking, scale);
  std::vector<std::optional<StackPlace>> stacks(set.pieces.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i]) continue;
    places[i]->chart = loose[places[i]->chart];
    stacks[loose[i]] = std::move(places[i]);
  }
  return stacks;
}

struct Arrangement {
  std::vector<std::optional<StackPlace>> stacks;  // by chart
  std::vector<std::size_t> lowest;                // charts that lie on none
  Packing packing;                                // of these
};

// Arranges the lowest charts of all stacks. Throws Stopped.
Arrangement arrange(const ChartSet& set, PackOptions::Effort effort, const StopCheck& stop,
                    UnwrapRun& run) {
  const AddedSeconds time(run.seconds.pack);
  stop.poll();
  run.record.begin(Activity::Packing);
  PackOptions options = *run.options.packing;
  options.fixed.clear();
  options.effort = effort;
  require_pinned_apart(set, run);
  Arrangement arrangement;
  arrangement.stacks = stacks_of(set, run.options);
  std::vector<BezierMap> maps;
  for (std::size_t k = 0; k < set.pieces.size(); ++k) {
    if (arrangement.stacks[k]) continue;
    arrangement.lowest.push_back(k);
    maps.push_back(*set.pieces[k].chart.map);
    options.fixed.push_back(!set.pieces[k].chart.pins.empty());
  }
  arrangement.packing = pack(maps, options, run.record.telling(stop));
  return arrangement;
}

// Puts the other charts on those that are packed, and returns the packing of all.
Packing stacked(ChartSet& set, const std::vector<std::size_t>& lowest, Packing packing,
                const UnwrapRun& run) {
  if (lowest.size() == set.pieces.size()) return packing;
  std::vector<std::size_t> number(set.pieces.size());  // in the packing
  for (std::size_t i = 0; i < lowest.size(); ++i) number[lowest[i]] = i;
  Packing all = packing;
  all.charts.clear();
  all.placements.clear();
  all.tiles.clear();
  for (std::size_t k = 0; k < set.pieces.size(); ++k) {
    Chart& chart = set.pieces[k].chart;
    const std::size_t under = number[chart.place ? chart.place->chart : k];
    if (chart.place) {
      const Chart& lower = set.pieces[chart.place->chart].chart;
      set_map(set.pieces[k], map_on(packing.charts[under], *chart.map, *chart.place), run);
      // The chart has the control points of the lower chart.
      chart.measures.locally_injective = lower.measures.locally_injective;
    }
    all.charts.push_back(*chart.map);
    all.placements.push_back(packing.placements[under]);
    all.tiles.push_back(packing.tiles[under]);
  }
  return all;
}

ChartSet lay_out(ChartSet set, Arrangement arrangement, UnwrapRun& run) {
  const AddedSeconds time(run.seconds.pack);
  for (std::size_t k = 0; k < set.pieces.size(); ++k)
    set.pieces[k].chart.place = std::move(arrangement.stacks[k]);
  for (std::size_t i = 0; i < arrangement.lowest.size(); ++i) {
    const ChartPiece& piece = set.pieces[arrangement.lowest[i]];
    Chart& chart = set.pieces[arrangement.lowest[i]].chart;
    chart.map = arrangement.packing.charts[i];
    const bool was_injective = chart.measures.locally_injective;
    chart.measures =
        measures_once_moved(std::move(chart.measures), *chart.map, piece.options.map.energy);
    chart.measures.locally_injective = was_injective;  // proven by pack(), by more than bounds
  }
  set.packing = stacked(set, arrangement.lowest, std::move(arrangement.packing), run);
  return set;
}

}  // namespace

ChartSet place(ChartSet set, UnwrapRun& run) {
  Arrangement arrangement;
  try {
    arrangement = arrange(set, PackOptions::Effort::Smallest, run.record.start_stop(), run);
  } catch (const Stopped& stop) {
    arrangement = arrange(set, PackOptions::Effort::Quick, {}, run);
    set.packed = stopped_status(stop.why());
    if (set.division == Status::Converged) set.division = set.packed;
  }
  return lay_out(std::move(set), std::move(arrangement), run);
}

ChartSet place_smallest(ChartSet set, UnwrapRun& run) {
  Arrangement arrangement =
      arrange(set, PackOptions::Effort::Smallest, run.record.start_stop(), run);
  return lay_out(std::move(set), std::move(arrangement), run);
}

BezierMap map_on(const BezierMap& under, const BezierMap& map, const StackPlace& place) {
  const TriangleIndices& ix = TriangleIndices::of_degree(map.degree());
  const double sign = place.sense == ChartSense::Mirrored ? -1 : 1;
  Vec x(map.control_points().size());
  for (Index f = 0; f < map.mesh().face_count(); ++f)
    for (int l = 0; l < ix.count(); ++l) {
      std::array<int, 3> multi{};
      for (std::size_t k = 0; k < 3; ++k)
        multi[to_size(place.corner[to_size(f)][k])] = ix.multi(l)[k];
      const Index node =
          under.space().cells()(place.face[to_size(f)], ix.local(multi[0], multi[1], multi[2]));
      const Vector2 uv = under.control_points().segment<2>(2 * node);
      x.segment<2>(2 * map.space().cells()(f, l)) = Vector2(sign * uv.x(), uv.y());
    }
  return map.with(map.shared_space(), std::move(x));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
