#include "majorant/parametrization/atlas/internal/stretch_limit.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "majorant/framework/minimizer.h"
#include "majorant/mesh/connectivity.h"
#include "majorant/parametrization/atlas/internal/chart_cutting.h"
#include "majorant/parametrization/atlas/internal/chart_maps.h"
#include "majorant/parametrization/initialization/strip_unfolding.h"

namespace majorant {
namespace {

// A chart that has not converged after this many iterations is cut, like one that has stalled. A
// smaller limit was set by the caller, who wants the map as it is then.
const int kLongSolveIterations = StoppingRules().max_iterations;
// A chart is cut this many times as one piece before it is parted in two.
constexpr int kMaxCuts = 2;
// A part with more than this fraction of its parent's area that exceeds the limit again is halved
// between its ends. Parting it around planes once more would cut off little, at the cost of another
// map of the rest.
constexpr double kLargePartShare = 0.875;
// Estimates below this fraction of the measured excess stretch (stretch - 1) are not trusted.
constexpr double kMinEstimateRatio = 0.3;
// Cutting again aims at this fraction of the allowed excess, so that one pass suffices.
constexpr double kTargetFraction = 0.85;
// The largest distance between the two sides of a closed cut in the unfolded chart, in square roots
// of its area. Rounding errors are a millionth of it.
constexpr double kClosedCutGap = 1e-9;

bool may_be_cut(const ChartPiece& piece, const UnwrapRun& run) {
  const Chart& chart = piece.chart;
  if (piece.mesh->face_count() == 1 || is_held(piece)) return false;
  if (chart.status == Status::Failed) return true;
  const bool is_at_end =
      chart.status == Status::MaxIterations && run.record.iterations_left() >= kLongSolveIterations;
  const bool is_done =
      chart.status == Status::Converged || chart.status == Status::Stalled || is_at_end;
  return is_done && is_stretched(run.options, chart);
}

// Returns half-edges of the surface along cuts of the piece whose two sides coincide once it is
// unfolded, without CutOptions::given.
std::vector<Index> closed_cuts(const ChartPiece& piece, const UnwrapRun& run) {
  const SurfaceMesh& mesh = *piece.mesh;
  const HalfEdgeFlags& given = run.options.cuts.given;
  const Vec uv = unfolded(mesh);
  const double gap = std::max(kClosedCutGap * std::sqrt(mesh.area()), run.clearance);
  const auto meet = [&](Index a, Index b) {
    return (uv.segment<2>(2 * a) - uv.segment<2>(2 * b)).norm() <= gap;
  };
  std::vector<Index> closed;
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    if (mesh.opposite(h) >= 0) continue;
    const Index one = 3 * piece.faces[face_of(h)] + corner_of(h);
    const Index other = run.surface.opposite(one);
    if (other < 0 || (!given.empty() && (given[one] || given[other]))) continue;
    const auto face = std::lower_bound(piece.faces.begin(), piece.faces.end(), face_of(other));
    if (face == piece.faces.end() || *face != face_of(other)) continue;
    const Index o = 3 * static_cast<Index>(face - piece.faces.begin()) + corner_of(other);
    if (meet(mesh.from_vertex(h), mesh.to_vertex(o)) &&
        meet(mesh.to_vertex(h), mesh.from_vertex(o)))
      closed.push_back(one);
  }
  return closed;
}

// A chart and the cuts of it that are closed.
struct OpenChart {
  std::size_t number = 0;
  std::vector<Index> half_edges;  // of the surface, to be closed
  SurfacePiece closed;
};

// Returns those of the charts that are unfolded, overlap, and stay planar when coinciding cuts are
// closed. A flat ring that was cut open is an example.
std::vector<OpenChart> charts_to_close(const ChartSet& set, const std::vector<std::size_t>& which,
                                       const UnwrapRun& run) {
  std::map<Index, OpenChart> by_face;  // the first one of the chart
  HalfEdgeFlags is_cut = set.cuts.is_cut;
  for (const std::size_t k : which) {
    const ChartPiece& piece = set.pieces[k];
    if (piece.chart.status != Status::Failed || !is_cut_where_it_overlaps(piece, run.options))
      continue;
    std::vector<Index> closed = closed_cuts(piece, run);
    if (closed.empty()) continue;
    for (const Index h : closed) is_cut[h] = is_cut[run.surface.opposite(h)] = 0;
    by_face[piece.faces.front()] = {k, std::move(closed), {}};
  }
  std::vector<OpenChart> open;
  if (by_face.empty()) return open;
  for (SurfacePiece& part : run.surface.cut_along(is_cut, nullptr).split()) {
    const auto found = by_face.find(part.face.front());
    if (found == by_face.end() || !is_planar(*part.mesh)) continue;
    open.push_back(std::move(found->second));
    open.back().closed = std::move(part);
  }
  return open;
}

ChartSet close_and_solve(ChartSet set, std::vector<OpenChart> open, UnwrapRun& run) {
  std::vector<std::size_t> changed;
  for (OpenChart& chart : open) {
    remove_cuts(run.surface, run.options.cuts, chart.half_edges, set.cuts);
    set.pieces[chart.number] =
        piece_of(std::move(chart.closed.mesh), std::move(chart.closed.face), run);
    changed.push_back(chart.number);
  }
  return solve(std::move(set), std::move(changed), run);
}

// Returns flags of the further cuts of a chart: as one piece first, then in two.
HalfEdgeFlags further_cut(const ChartPiece& piece, const UnwrapOptions& options,
                          const StopCheck& stop) {
  const SurfaceMesh& mesh = *piece.mesh;
  const CutPreferences& preferences = piece.preferences;
  HalfEdgeFlags cuts;
  if (piece.chart.status == Status::Failed && is_cut_where_it_overlaps(piece, options)) {
    cuts = cut_across(mesh, preferences, PathsAcross::FromOverlaps, stop);
  } else if (piece.chart.status != Status::Failed && piece.cut_count < kMaxCuts) {
    const double excess = piece.chart.stretch.l2 - 1;
    const double estimate = estimated_stretch(mesh, stop) - 1;
    if (estimate > kMinEstimateRatio * excess)
      cuts = cut_further(mesh, preferences,
                         1 + kTargetFraction * estimate * (options.cuts.max_stretch - 1) / excess,
                         stop);
    else
      cuts = cut_corners(mesh, preferences, stop);
  }
  if (is_any(cuts)) return cuts;
  const bool is_large_part = piece.area_share < 1 && piece.area_share > kLargePartShare;
  return cut_in_two(mesh, preferences, is_large_part ? PartsAround::Ends : PartsAround::Planes,
                    stop);
}

std::vector<HalfEdgeFlags> further_cuts(const ChartSet& set, const std::vector<std::size_t>& which,
                                        const UnwrapOptions& options, const StopCheck& stop) {
  const double all = face_count(set, which);
  double done = 0;
  return cut_alike(set, which, options.stacking, [&](const ChartPiece& piece) {
    const double before = std::exchange(done, done + piece.mesh->face_count());
    return further_cut(piece, options, stop.between(before / all, done / all));
  });
}

// Returns the charts to cut. Once the run is over, returns only those without a map.
std::vector<std::size_t> bad_charts(const ChartSet& set, bool is_over, const UnwrapRun& run) {
  std::vector<std::size_t> bad;
  for (std::size_t k = 0; k < set.pieces.size(); ++k) {
    const ChartPiece& piece = set.pieces[k];
    if (may_be_cut(piece, run) && (!is_over || piece.chart.status == Status::Failed))
      bad.push_back(k);
  }
  return bad;
}

ChartSet cut_bad_charts(ChartSet set, UnwrapRun& run) {
  const StopCheck& start_stop = run.record.start_stop();
  try {
    for (;;) {
      const bool is_over = !run.may_continue();
      const std::vector<std::size_t> bad = bad_charts(set, is_over, run);
      if (bad.empty()) return set;
      if (is_over) start_stop.poll();
      if (std::vector<OpenChart> open = charts_to_close(set, bad, run); !open.empty()) {
        set = close_and_solve(std::move(set), std::move(open), run);
      } else if (is_over) {
        const std::vector<HalfEdgeFlags> cuts = further_cuts(set, bad, run.options, start_stop);
        CutCharts parts = cut_charts(std::move(set), bad, cuts, run);
        set = solve(std::move(parts.set), std::move(parts.changed), run);
      } else {
        const auto choose = [&](const ChartSet& charts, const StopCheck& stop) {
          return further_cuts(charts, bad, run.options, stop);
        };
        set = cut_and_solve(std::move(set), bad, choose, run).set;
      }
    }
  } catch (const Stopped&) {  // before any step has moved the set
  }
  return set;
}

}  // namespace

ChartSet limit_stretch(ChartSet set, UnwrapRun& run) {
  set = cut_bad_charts(std::move(set), run);
  const Status end = run.end();
  for (ChartPiece& piece : set.pieces)
    if (piece.chart.status != Status::Failed && may_be_cut(piece, run)) piece.chart.status = end;
  return in_order(std::move(set));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
