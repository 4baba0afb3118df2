#include "majorant/parametrization/atlas/internal/chart_cutting.h"

#include <fmt/format.h>

#include <algorithm>

#include "majorant/parametrization/atlas/internal/chart_maps.h"

namespace majorant {

CutCharts cut_charts(ChartSet set, const std::vector<std::size_t>& which,
                     const std::vector<HalfEdgeFlags>& cuts, const UnwrapRun& run) {
  CutCharts result;
  std::vector<Index> half_edges;
  for (std::size_t i = 0; i < which.size(); ++i) {
    const ChartPiece& parent = result.parents.emplace_back(std::move(set.pieces[which[i]]));
    const bool has_map = parent.chart.status != Status::Failed;
    const bool is_good = has_map && !is_stretched(run.options, parent.chart);
    for (Index h = 0; h < parent.mesh->half_edge_count(); ++h)
      if (cuts[i][h]) half_edges.push_back(3 * parent.faces[face_of(h)] + corner_of(h));
    std::size_t at = which[i];
    std::vector<Index> uncut_vertex;
    for (SurfacePiece& part : parent.mesh->cut_along(cuts[i], &uncut_vertex).split()) {
      std::vector<Index> faces, vertices;
      for (const Index f : part.face) faces.push_back(parent.faces[f]);
      for (const Index v : part.vertex) vertices.push_back(uncut_vertex[v]);
      if (at == set.pieces.size()) set.pieces.emplace_back();
      ChartPiece& piece = set.pieces[at] = piece_of(std::move(part.mesh), std::move(faces), run);
      if (has_map) piece.parent = uv_of_vertices(parent.chart, vertices);
      piece.area_share = piece.mesh->area() / parent.mesh->area();
      const bool is_part = piece.faces.size() < parent.faces.size();
      piece.cut_count = is_part ? 1 : parent.cut_count + 1;
      if (is_part && is_good) piece.parent_map = ParentMap::Whole;
      result.changed.push_back(at);
      at = set.pieces.size();
    }
  }
  add_cuts(run.surface, run.options.cuts, half_edges, set.cuts);
  result.set = std::move(set);
  return result;
}

Recut cut_and_solve(ChartSet set, const std::vector<std::size_t>& which, const CutChooser& choose,
                    UnwrapRun& run) {
  const RunRecord& record = run.record;
  const auto is_within_limits = [&] { return record.directive() == Directive::Continue; };
  const std::size_t count = set.pieces.size();
  run.begin_pass();
  record.begin(Activity::Cutting);
  record.announce(
      fmt::format("cutting again: {} of {} chart{}", which.size(), count, count == 1 ? "" : "s"));
  std::vector<HalfEdgeFlags> flags;
  try {
    flags = choose(set, record.telling(record.stop()));
  } catch (const Stopped&) {
    return {std::move(set), is_within_limits()};
  }
  SurfaceCuts before = set.cuts;
  CutCharts parts = cut_charts(std::move(set), which, flags, run);
  record.begin(Activity::Solving);
  set = solve(std::move(parts.set), std::move(parts.changed), run);
  if (is_within_limits()) return {std::move(set), true};
  set.cuts = std::move(before);
  set.pieces.resize(count);
  for (std::size_t i = 0; i < which.size(); ++i) set.pieces[which[i]] = std::move(parts.parents[i]);
  return {std::move(set), false};
}

std::vector<HalfEdgeFlags> cut_alike(
    const ChartSet& set, const std::vector<std::size_t>& which, Stacking stacking,
    const std::function<HalfEdgeFlags(const ChartPiece& piece)>& cut) {
  std::vector<std::shared_ptr<const SurfaceMesh>> surfaces;
  for (const std::size_t k : which) surfaces.push_back(set.pieces[k].mesh);
  const std::vector<std::optional<StackPlace>> places = stack_places(surfaces, stacking, {});
  std::vector<HalfEdgeFlags> cuts;
  for (std::size_t i = 0; i < which.size(); ++i)
    cuts.push_back(places[i] ? flags_on(cuts[places[i]->chart], *places[i])
                             : cut(set.pieces[which[i]]));
  return cuts;
}

Vec uv_of_vertices(const Chart& chart, const std::vector<Index>& vertices) {
  Vec uv(2 * static_cast<Index>(vertices.size()));
  for (std::size_t v = 0; v < vertices.size(); ++v)
    uv.segment<2>(2 * static_cast<Index>(v)) =
        chart.map->control_points().segment<2>(2 * vertices[v]);
  return uv;
}

bool is_any(const HalfEdgeFlags& flags) {
  return std::find(flags.begin(), flags.end(), 1) != flags.end();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
