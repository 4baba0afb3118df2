// Functions of choose_cuts.h that cut one chart further.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/parametrization/seams/choose_cuts.h"
#include "majorant/parametrization/seams/cut_paths.h"
#include "majorant/parametrization/seams/internal/automatic_cut.h"
#include "majorant/parametrization/seams/internal/chart_paths.h"
#include "majorant/parametrization/seams/internal/cut_costs.h"
#include "majorant/parametrization/seams/internal/cut_terminals.h"
#include "majorant/parametrization/seams/internal/flattening_strain.h"
#include "majorant/parametrization/seams/internal/outline_bays.h"
#include "majorant/parametrization/seams/internal/pieces.h"
#include "majorant/parametrization/seams/internal/two_parts.h"

namespace majorant {
namespace {

// The least area of a part, as a fraction of the chart's.
constexpr double kMinPartArea = 0.04;

// Returns these cuts along straighter paths, if those leave as many parts and each is planar.
std::vector<char> smoothed(const SurfaceMesh& chart, const CutPreferences& preferences,
                           std::vector<char> is_cut, const StopCheck& stop) {
  std::vector<char> straight = is_cut;
  smooth_cuts(chart, {}, cut_costs(chart, preferences), straight, stop);
  if (straight == is_cut) return is_cut;
  const auto parts = [&](const std::vector<char>& flags) {
    return chart.cut_along(flags, nullptr).split(stop);
  };
  const std::vector<SurfacePiece> after = parts(straight);
  const bool is_planar_each = std::all_of(
      after.begin(), after.end(), [](const SurfacePiece& part) { return is_planar(*part.mesh); });
  return is_planar_each && after.size() == parts(is_cut).size() ? straight : is_cut;
}

// Returns the area of the smaller one of the two parts that these cuts leave.
double smaller_area(const SurfaceMesh& chart, const std::vector<char>& is_cut) {
  std::vector<Index> opposite = chart.opposites();
  for (std::size_t h = 0; h < opposite.size(); ++h)
    if (is_cut[h]) opposite[h] = -1;
  const std::vector<Index> part = face_components(opposite);
  double area[2] = {0, 0};
  for (Index f = 0; f < chart.face_count(); ++f) area[part[f] > 0] += area_vector(chart, f).norm();
  return std::min(area[0], area[1]);
}

std::vector<char> flags_of_path(const SurfaceMesh& chart, const PathSearch& search, Index end) {
  std::vector<char> is_cut(to_size(chart.half_edge_count()), 0);
  for (Index v = end; search.entered[v].first >= 0; v = search.entered[v].first)
    if (const Index h = search.entered[v].second, o = chart.opposite(h); o >= 0)
      is_cut[h] = is_cut[o] = 1;
  return is_cut;
}

// Returns the path of least cost per area of its smaller side; no flags if there is none.
std::vector<char> cheapest_path(const SurfaceMesh& chart, const CutPreferences& preferences,
                                PathsAcross kind, const StopCheck& stop) {
  const ChartPaths paths(chart, cut_costs(chart, preferences), longest_loop(chart));
  std::vector<char> best(to_size(chart.half_edge_count()), 0);
  double least_price = std::numeric_limits<double>::infinity();
  const auto compare = [&](const PathSearch& search, Index end) {
    std::vector<char> is_cut = flags_of_path(chart, search, end);
    const double price = search.distance[end] / smaller_area(chart, is_cut);
    if (!(price < least_price)) return;
    least_price = price;
    best = std::move(is_cut);
  };
  const Index corner = kind == PathsAcross::FromOverlaps ? paths.overlapping_corner() : -1;
  if (corner >= 0)
    paths.find_around(corner, stop, compare);
  else
    paths.find_between_ends(stop, compare);
  return best;
}

// Returns the path of a search to one vertex, and its parts in the map. None if one part has almost
// no area, or nothing is cut.
std::optional<PathAcross> path_to(const SurfaceMesh& chart, const Vec& uv, const ChartPaths& paths,
                                  const PathSearch& search, Index end) {
  PathAcross path;
  std::vector<Index> vertices{end};
  for (Index v = end; search.entered[to_size(v)].first >= 0;) {
    const auto [before, h] = search.entered[to_size(v)];
    if (chart.opposite(h) >= 0) path.half_edges.push_back(h);
    vertices.push_back(v = before);
  }
  if (path.half_edges.empty()) return std::nullopt;
  std::reverse(vertices.begin(), vertices.end());
  const std::vector<Index>& outline = paths.outline();
  const auto add_between = [&](Index from, Index to, std::vector<Index>& loop) {
    const Index first = paths.steps(outline.front(), from);
    for (Index k = 1; k < paths.steps(from, to); ++k)
      loop.push_back(outline[to_size(first + k) % outline.size()]);
  };
  path.outlines[0] = vertices;
  add_between(end, vertices.front(), path.outlines[0]);
  path.outlines[1].assign(vertices.rbegin(), vertices.rend());
  add_between(vertices.front(), end, path.outlines[1]);
  path.smaller_area =
      std::min(enclosed_area(uv, path.outlines[0]), enclosed_area(uv, path.outlines[1]));
  if (!(path.smaller_area > kMinPartArea * enclosed_area(uv, outline))) return std::nullopt;
  for (const Index h : path.half_edges) path.length += chart.edge_length(h);
  return path;
}

// Returns the vertices to which a bay's paths lead: the nearest one of each window of the outline,
// and the bottoms of other bays.
std::vector<Index> ends_from_bay(const ChartPaths& paths, const PathSearch& search, Index bottom,
                                 const std::vector<Index>& bottoms) {
  const auto n = static_cast<Index>(paths.outline().size());
  std::vector<Index> ends(ChartPaths::kWindows, -1);
  for (const Index w : paths.outline()) {
    if (w == bottom || search.entered[to_size(w)].first < 0) continue;
    Index& best = ends[to_size(paths.steps(bottom, w) * ChartPaths::kWindows / n)];
    if (best < 0 || search.distance[to_size(w)] < search.distance[to_size(best)]) best = w;
  }
  ends.insert(ends.end(), bottoms.begin(), bottoms.end());
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  std::erase_if(ends, [&](Index w) { return w < 0 || w == bottom; });
  return ends;
}

// Returns the boundary loop that encloses the others in the map.
const std::vector<Index>& outer_loop(const SurfaceMesh& chart, const Vec& uv) {
  const auto& loops = chart.boundary_loops();
  return *std::max_element(loops.begin(), loops.end(), [&](const auto& a, const auto& b) {
    return enclosed_area(uv, a) < enclosed_area(uv, b);
  });
}

}  // namespace

std::vector<char> cut_further(const SurfaceMesh& chart, const CutPreferences& preferences,
                              double max_stretch, const StopCheck& stop) {
  CutRequest request{preferences, std::vector<char>(to_size(chart.vertex_count()), 0)};
  request.images = Images::Ignored;
  return automatic_cut(chart, request, max_stretch, stop).is_cut;
}

std::vector<char> cut_corners(const SurfaceMesh& chart, const CutPreferences& preferences,
                              const StopCheck& stop) {
  std::vector<char> none(to_size(chart.half_edge_count()), 0);
  const std::vector<char> whole(to_size(chart.vertex_count()), 0);
  const std::vector<Index> curved = curved_vertices(angle_defects(chart), whole);
  if (curved.empty() || curved.size() > kMaxTerminals) return none;
  return straight_cut_graph(chart, curved, cut_costs(chart, preferences), stop);
}

std::vector<char> cut_in_two(const SurfaceMesh& chart, const CutPreferences& preferences,
                             PartsAround centres, const StopCheck& stop) {
  return smoothed(chart, preferences,
                  border_of_two_parts(chart, cut_costs(chart, preferences), centres, stop), stop);
}

std::vector<char> cut_across(const SurfaceMesh& chart, const CutPreferences& preferences,
                             PathsAcross paths, const StopCheck& stop) {
  return smoothed(chart, preferences, cheapest_path(chart, preferences, paths, stop), stop);
}

std::vector<PathAcross> paths_across(const SurfaceMesh& chart, const CutPreferences& preferences,
                                     const Vec& uv, const StopCheck& stop) {
  const ChartPaths paths(chart, cut_costs(chart, preferences), outer_loop(chart, uv));
  std::vector<PathAcross> all;
  const auto add = [&](const PathSearch& search, Index end) {
    if (std::optional<PathAcross> path = path_to(chart, uv, paths, search, end))
      all.push_back(std::move(*path));
  };
  paths.find_between_ends(stop, add);
  const std::vector<Index> bottoms = bay_bottoms(uv, paths.outline());
  for (const Index v : bottoms) {
    stop.poll();
    const PathSearch search = paths.all_from(v);
    for (const Index w : ends_from_bay(paths, search, v, bottoms)) add(search, w);
  }
  return all;
}

std::vector<char> cut_along_path(const SurfaceMesh& chart, const CutPreferences& preferences,
                                 const PathAcross& path, const StopCheck& stop) {
  std::vector<char> is_cut(to_size(chart.half_edge_count()), 0);
  for (const Index h : path.half_edges) is_cut[h] = is_cut[chart.opposite(h)] = 1;
  return smoothed(chart, preferences, std::move(is_cut), stop);
}

double estimated_stretch(const SurfaceMesh& chart, const StopCheck& stop) {
  return stretch_of_strain(FlatteningStrain(chart, stop).strain());
}

bool unfolds(const SurfaceMesh& chart) {
  return chart.rest_triangles().empty() && angle_defects(chart).cwiseAbs().maxCoeff() <= kCurved;
}

bool unfolds_at_creases(const SurfaceMesh& chart, const CutPreferences& preferences) {
  if (!unfolds(chart)) return false;
  if (dihedral_angles(chart).maxCoeff() <= kCurved) return true;
  const Vec sharp = sharpness(chart, preferences.creases);
  for (Index h = 0; h < chart.half_edge_count(); ++h)
    if (sharp[h] > 0 && chart.opposite(h) >= 0) return true;
  return false;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
