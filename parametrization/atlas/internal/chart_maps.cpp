#include "majorant/parametrization/atlas/internal/chart_maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <string>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/stopwatch.h"
#include "majorant/mesh/texture_borders.h"
#include "majorant/parametrization/atlas/internal/kept_islands.h"

namespace majorant {
namespace {

// Charts with at least this many faces are solved one at a time, with all threads. Loops over fewer
// elements are too short for several threads to pay.
constexpr Index kParallelChartFaces = 5000;

ChartHints hints_of(const ChartPiece& piece, const UnwrapRun& run) {
  ChartHints hints;
  hints.parent = piece.parent;
  hints.parent_map = piece.parent_map;
  hints.clearance = run.clearance;
  if (run.options.cuts.method == CutMethod::Texture && is_textured(*piece.mesh, 0))
    hints.texture = TextureStart::Tried;
  if (unfolds(*piece.mesh) && !is_held(piece)) hints.shape = ChartShape::Unfolds;
  if (is_cut_where_it_overlaps(piece, run.options)) hints.overlaps = UnfoldedOverlaps::LeftToCuts;
  if (may_cut(run.options) && has_room_to_divide(piece)) hints.slow = SlowStart::LeftToCuts;
  return hints;
}

// Maps one chart. starting: is called with the fraction of the initial map that is done, if that
// takes long.
void solve_piece(ChartPiece& piece, RunObserver* observer, StopCheck::Tell starting,
                 const UnwrapRun& run) {
  if (run.record.start_stop()() != Directive::Continue) {  // before there is a map
    piece.chart.map.reset();
    return;
  }
  RunRecord record = run.record.part(observer, std::move(starting));
  Chart chart = ChartSolver(piece.mesh, piece.options, hints_of(piece, run)).solve(record);
  chart.faces = piece.faces;
  piece.chart = std::move(chart);
}

}  // namespace

ChartSet solve(ChartSet set, std::vector<std::size_t> which, UnwrapRun& run) {
  const AddedSeconds time(run.seconds.map);
  const RunRecord& record = run.record;
  const double all = face_count(set, which);
  std::atomic<Index> done = 0;  // faces
  std::stable_sort(which.begin(), which.end(), [&](std::size_t a, std::size_t b) {
    return set.pieces[a].mesh->face_count() > set.pieces[b].mesh->face_count();
  });
  const auto name = [&](std::size_t number) {
    return fmt::format("chart {} of {}", number, which.size());
  };
  const auto solve_one = [&](std::size_t k, RunObserver* observer, StopCheck::Tell starting) {
    const Index faces = set.pieces[k].mesh->face_count();
    solve_piece(set.pieces[k], observer, std::move(starting), run);
    record.advance((done += faces) / all);
  };
  std::size_t large = 0;
  for (; large < which.size() && set.pieces[which[large]].mesh->face_count() >= kParallelChartFaces;
       ++large) {
    record.announce(name(large + 1));
    int percent = 0;  // of its start, announced last
    solve_one(which[large], record.observer(), [&, chart = name(large + 1)](double share) {
      const int now = static_cast<int>(100 * share);
      if (now <= std::exchange(percent, std::max(percent, now))) return;
      record.announce(now < 100 ? fmt::format("{}, start {} %", chart, now) : chart);
    });
  }
  std::size_t solved = large;
  std::mutex failing, announcing;
  std::exception_ptr failure;
  std::size_t failed = set.pieces.size();  // the first failure in the order of charts is thrown
  parallel_for(static_cast<Index>(which.size() - large), 1, [&](Index task) {
    const std::size_t k = which[large + to_size(task)];
    try {
      solve_one(k, nullptr, {});
      const std::lock_guard lock(announcing);
      if (record.observer())
        record.observer()->after_part(name(large + to_size(task) + 1), set.pieces[k].chart.trace);
      record.announce(name(++solved));
    } catch (...) {
      const std::lock_guard lock(failing);
      if (k < failed) failure = std::current_exception();
      failed = std::min(failed, k);
    }
  });
  if (failure) std::rethrow_exception(failure);
  return set;
}

ChartSet solve(ChartSet set, UnwrapRun& run) {
  std::vector<std::size_t> all = all_charts(set);
  return solve(std::move(set), std::move(all), run);
}

ChartSet keep_islands(ChartSet set, UnwrapRun& run) {
  const AddedSeconds time(run.seconds.map);
  std::vector<std::shared_ptr<const SurfaceMesh>> islands;
  for (const ChartPiece& piece : set.pieces) islands.push_back(piece.mesh);
  std::vector<BezierMap> maps = kept_islands(islands);
  for (std::size_t k = 0; k < maps.size(); ++k) {
    ChartPiece& piece = set.pieces[k];
    Chart& chart = piece.chart;
    chart.faces = piece.faces;
    chart.start = ChartStart::Texture;
    chart.status = Status::Converged;
    chart.message = "kept as it is";
    set_map(piece, std::move(maps[k]), run);
    chart.measures.locally_injective = true;  // exactly, by kept_islands()
  }
  return set;
}

ChartSet scaled(ChartSet set, const UnwrapRun& run) {
  const Vec& face_scale = run.options.face_scale;
  if (face_scale.size() == 0) return set;
  for (ChartPiece& piece : set.pieces) {
    Chart& chart = piece.chart;
    const double scale = face_scale[piece.faces.front()];
    for (const Index f : piece.faces)
      if (face_scale[f] != scale)
        throw InvalidArgument("unwrap: face_scale differs within a chart");
    if (scale == 1 || !chart.map) continue;
    const bool was_injective = chart.measures.locally_injective;
    set_map(piece,
            chart.map->with(chart.map->shared_space(), Vec(scale * chart.map->control_points())),
            run);
    chart.measures.locally_injective = was_injective;  // pack() proves it anew
  }
  return set;
}

void set_map(ChartPiece& piece, BezierMap map, const UnwrapRun& run) {
  piece.chart.measures = measure_map(map, piece.options.map.energy, run.record.start_stop());
  piece.chart.stretch = measure_stretch(map);
  piece.chart.map = std::move(map);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
