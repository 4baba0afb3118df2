#include "majorant/parametrization/atlas/internal/chart_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>

#include "majorant/framework/error.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/mesh/refusal.h"

namespace majorant {
namespace {

// The smallest distance between parts of a chart's border that are not neighbours along it, in
// square roots of the surface's area. Single precision still separates them: it rounds a square
// with a side of 1.4 such roots by at most 4e-8 of its side.
constexpr double kClearance = 2.5e-7;
// Upper bound on passes through cutting and solving, the first one included: a guard against
// endless cutting.
constexpr int kMaxPasses = 100;
// Charts of at most this many faces are not divided for the sake of the layout.
constexpr Index kIndivisibleFaces = 2;

// Requires that every vertex of the input with a target has only one place in the layout.
void require_one_place(const std::vector<Index>& surface_vertex, const std::vector<Pin>& points,
                       const UnwrapRun& run) {
  const SurfaceMesh& surface = run.surface;
  std::vector<Index> copies(to_size(surface.vertex_count()), 0);
  for (const Index v : surface_vertex) ++copies[v];
  std::map<Index, Index> places;  // by vertex of the input
  for (const Pin& p : points)
    if (p.target) places[surface.input_vertex(p.vertex)] += copies[p.vertex];
  for (const Pin& p : points) {
    const Index name = surface.input_vertex(p.vertex);
    if (!p.target || places.at(name) == 1) continue;
    const bool is_split = copies[p.vertex] == 1;
    const bool is_automatic = run.options.cuts.method == CutMethod::Automatic;
    const std::string problem = fmt::format(
        "{}vertex {} has a target, but {} places in the layout: {}; choose another vertex",
        message_prefix(surface), name, places.at(name),
        is_split ? "sheets were split there" : "it lies on a seam");
    if (is_split || is_automatic) throw Error(ErrorKind::Infeasible, problem);
    throw Refusal(ErrorKind::Infeasible, surface.file(), problem + ", or ", Hint::AutomaticCuts,
                  ", which avoids it");
  }
}

// Returns the pins of a piece: every copy of a vertex is held.
std::vector<Pin> pins_on(const SurfacePiece& piece, const std::vector<Index>& surface_vertex,
                         const std::vector<Pin>& pins) {
  std::vector<Pin> held;
  if (pins.empty()) return held;
  for (std::size_t v = 0; v < piece.vertex.size(); ++v)
    for (const Pin& p : pins)
      if (surface_vertex[piece.vertex[v]] == p.vertex)
        held.push_back({static_cast<Index>(v), p.target});
  return held;
}

Vec weights_on(const std::vector<Index>& faces, const Vec& all) {
  return all.size() == 0 ? Vec() : Vec(all(faces));
}

}  // namespace

Status ChartSet::status() const {
  Status worst = worse_of(unmapped.status, packed);
  for (const ChartPiece& piece : pieces) worst = worse_of(worst, piece.chart.status);
  return worst;
}

UnwrapRun::UnwrapRun(const SurfaceMesh& mesh, const UnwrapOptions& unwrap_options,
                     RunRecord& run_record)
    : surface(mesh),
      options(unwrap_options),
      record(run_record),
      clearance(kClearance * std::sqrt(mesh.area())) {}

bool UnwrapRun::may_continue() const {
  return record.directive() == Directive::Continue && pass < kMaxPasses;
}

Status UnwrapRun::end() const {
  const Directive why = record.directive();
  return why == Directive::Continue ? Status::MaxIterations : stopped_status(why);
}

void UnwrapRun::begin_pass() { record.begin_pass(kMaxPasses - ++pass); }

ChartSet charts_along(SurfaceCuts cuts, const UnwrapRun& run) {
  const MapOptions& map = run.options.chart.map;
  ChartSet set;
  std::vector<Index> surface_vertex;
  const SurfaceMesh cut = run.surface.cut_along(cuts.is_cut, &surface_vertex);
  require_one_place(surface_vertex, map.pins, run);
  require_one_place(surface_vertex, map.handles, run);
  for (SurfacePiece& part : cut.split(run.record.start_stop())) {
    std::vector<Pin> pins = pins_on(part, surface_vertex, map.pins);
    std::vector<Pin> handles = pins_on(part, surface_vertex, map.handles);
    // Faces keep their numbers where the surface is cut.
    ChartPiece& piece =
        set.pieces.emplace_back(piece_of(std::move(part.mesh), std::move(part.face), run));
    piece.options.map.pins = std::move(pins);
    piece.options.map.handles = std::move(handles);
  }
  set.cuts = std::move(cuts);
  return set;
}

ChartPiece piece_of(std::shared_ptr<const SurfaceMesh> mesh, std::vector<Index> faces,
                    const UnwrapRun& run) {
  ChartPiece piece;
  piece.options = run.options.chart;
  piece.options.solve.threads = 0;
  piece.options.map.pins.clear();
  piece.options.map.handles.clear();
  piece.options.map.face_weight = weights_on(faces, run.options.chart.map.face_weight);
  piece.options.map.energy = for_elements(run.options.chart.map.energy, faces);
  piece.preferences = preferences_on(faces, run.options.cuts.preferences);
  piece.mesh = std::move(mesh);
  piece.faces = std::move(faces);
  return piece;
}

std::vector<std::size_t> all_charts(const ChartSet& set) {
  std::vector<std::size_t> all(set.pieces.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

double face_count(const ChartSet& set, const std::vector<std::size_t>& which) {
  double faces = 0;
  for (const std::size_t k : which) faces += set.pieces[k].mesh->face_count();
  return faces;
}

ChartSet in_order(ChartSet set) {
  std::sort(set.pieces.begin(), set.pieces.end(), [](const ChartPiece& a, const ChartPiece& b) {
    return a.faces.front() < b.faces.front();
  });
  return set;
}

ChartSet without_unmapped(ChartSet set, const UnwrapRun& run) {
  const Directive why = run.record.start_stop()();
  if (why == Directive::Continue) return set;
  UnmappedCharts& unmapped = set.unmapped;
  std::vector<ChartPiece> mapped;
  for (ChartPiece& piece : set.pieces) {
    if (piece.chart.map && piece.chart.status != Status::Failed) {
      mapped.push_back(std::move(piece));
      continue;
    }
    unmapped.faces.insert(unmapped.faces.end(), piece.faces.begin(), piece.faces.end());
    ++unmapped.count;
  }
  if (mapped.empty()) throw Stopped(why);
  std::sort(unmapped.faces.begin(), unmapped.faces.end());
  if (unmapped.count > 0) unmapped.status = stopped_status(why);
  set.pieces = std::move(mapped);
  return set;
}

bool lacks_maps(const ChartSet& set) {
  return std::any_of(set.pieces.begin(), set.pieces.end(), [](const ChartPiece& piece) {
    return !piece.chart.map || piece.chart.status == Status::Failed;
  });
}

bool may_cut(const UnwrapOptions& options) {
  return options.limit == StretchLimit::Kept && options.islands == Islands::Mapped &&
         chooses_cuts(options.cuts.method);
}

bool is_stretched(const UnwrapOptions& options, const Chart& chart) {
  return may_cut(options) && exceeds_stretch(options, chart);
}

bool is_held(const ChartPiece& piece) {
  return !piece.options.map.pins.empty() || !piece.options.map.handles.empty();
}

bool has_room_to_divide(const ChartPiece& piece) {
  return piece.mesh->face_count() > kIndivisibleFaces && !is_held(piece);
}

bool is_cut_where_it_overlaps(const ChartPiece& piece, const UnwrapOptions& options) {
  return may_cut(options) && !is_held(piece) && unfolds_at_creases(*piece.mesh, piece.preferences);
}

bool has_one_scale(const UnwrapOptions& options) {
  return options.stacking == Stacking::None && options.face_scale.size() == 0 &&
         options.packing->tiles <= 1;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
