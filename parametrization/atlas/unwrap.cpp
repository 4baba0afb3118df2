#include "majorant/parametrization/atlas/unwrap.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "majorant/certify/global_injectivity.h"
#include "majorant/certify/proven_distance.h"
#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/mesh/model_unit.h"
#include "majorant/parametrization/atlas/internal/chart_maps.h"
#include "majorant/parametrization/atlas/internal/chart_set.h"
#include "majorant/parametrization/atlas/internal/division.h"
#include "majorant/parametrization/atlas/internal/fill.h"
#include "majorant/parametrization/atlas/internal/placement.h"
#include "majorant/parametrization/atlas/internal/stretch_limit.h"
#include "majorant/parametrization/solve/normalized_start.h"

namespace majorant {
namespace {

// Returns cuts that avoid pins and handles, as short as UnwrapOptions::cutting_seconds allow.
SurfaceCuts first_cuts(const UnwrapRun& run) {
  const RunRecord& record = run.record;
  CutOptions cuts = run.options.cuts;
  for (const auto* points : {&run.options.chart.map.pins, &run.options.chart.map.handles})
    for (const Pin& p : *points) cuts.whole.push_back(p.vertex);
  cuts.copies = run.options.stacking;
  const double limit = run.options.cutting_seconds;
  if (std::isfinite(limit))
    cuts.enough = StopCheck([&record, limit] {
      return record.seconds() > limit ? Directive::TimeLimit : Directive::Continue;
    });
  record.begin(Activity::Cutting);
  return choose_cuts(run.surface, cuts, record.telling(record.start_stop()));
}

Atlas atlas_of(ChartSet set, const AtlasSeconds& seconds) {
  Atlas atlas;
  atlas.cuts = std::move(set.cuts);
  for (ChartPiece& piece : set.pieces) atlas.charts.push_back(std::move(piece.chart));
  atlas.unmapped = std::move(set.unmapped);
  atlas.packing = std::move(set.packing);
  atlas.packed = set.packed;
  atlas.seconds = seconds;
  atlas.division = set.division;
  return atlas;
}

// Runs the steps of unwrap() in order. surface: of a size in the range of doubles.
Atlas unwrap_usable(const SurfaceMesh& surface, const UnwrapOptions& options, RunRecord& record) {
  const ThreadCount threads(options.chart.solve.threads);
  UnwrapRun run(surface, options, record);
  const double started = record.seconds();
  ChartSet set = charts_along(first_cuts(run), run);
  run.seconds.cut = record.seconds() - started;
  record.begin(Activity::Solving);
  if (options.islands == Islands::Kept) {
    set = keep_islands(std::move(set), run);
  } else {
    set = limit_stretch(solve(std::move(set), run), run);
    set = without_unmapped(std::move(set), run);
    if (set.is_complete()) set = divide(std::move(set), run);
    set = without_unmapped(std::move(set), run);
  }
  set = scaled(std::move(set), run);
  if (options.packing && set.status() != Status::Failed) set = place(std::move(set), run);
  if (set.packing && set.is_complete() && set.packed == Status::Converged && may_cut(options) &&
      has_one_scale(options))
    set = fill(std::move(set), run);
  AtlasSeconds& seconds = run.seconds;
  const double others = seconds.cut + seconds.map + seconds.pack;
  seconds.recut = std::max(0.0, record.seconds() - started - others);
  return atlas_of(std::move(set), seconds);
}

void scale_points(double factor, std::vector<Pin>& points) {
  for (Pin& p : points)
    if (p.target) *p.target *= factor;
}

// Returns whether the size is a finite normal number, with all its digits.
bool is_in_range(double size) {
  return size >= std::numeric_limits<double>::min() && std::isfinite(size);
}

void to_model_units(double unit, Packing& packing) {
  for (LayoutMotion& placement : packing.placements) placement.origin *= unit;
  packing.origin *= unit;
  packing.side *= unit;
  packing.border *= unit;
  packing.distance *= unit;
}

// Returns the map scaled by `unit` on a mesh of the same faces with other vertex numbers, and
// renumbers the pins.
BezierMap on_mesh(const BezierMap& map, const std::shared_ptr<const SurfaceMesh>& mesh, double unit,
                  std::vector<Pin>& pins) {
  const Cells &before = map.mesh().faces(), &after = mesh->faces();
  if (before == after) return {mesh, map.shared_space(), Vec(unit * map.control_points())};
  std::vector<Index> number(to_size(mesh->vertex_count()));
  for (Index c = 0; c < mesh->half_edge_count(); ++c)
    number[map.mesh().from_vertex(c)] = mesh->from_vertex(c);
  for (Pin& pin : pins) pin.vertex = number[pin.vertex];
  auto space =
      std::make_shared<const BezierTriangleSpace>(after, mesh->vertex_count(), map.degree());
  Vec x(2 * space->node_count());
  for (Index f = 0; f < after.rows(); ++f)
    for (Index l = 0; l < space->nodes_per_element(); ++l)
      x.segment<2>(2 * space->cells()(f, l)) =
          unit * map.control_points().segment<2>(2 * map.space().cells()(f, l));
  return {mesh, std::move(space), std::move(x)};
}

// Scales an atlas of the normalized surface back to model units. Both surfaces fall into the same
// pieces.
void to_model_units(const SurfaceMesh& surface, double unit, Atlas& atlas) {
  atlas.cuts.length *= unit;
  atlas.cuts.added_length *= unit;
  for (ComponentCuts& component : atlas.cuts.components) component.length *= unit;
  if (atlas.packing) to_model_units(unit, *atlas.packing);
  const std::vector<SurfacePiece> pieces = surface.cut_along(atlas.cuts.is_cut, nullptr).split();
  auto piece = pieces.begin();
  for (std::size_t k = 0; k < atlas.charts.size(); ++k) {
    Chart& chart = atlas.charts[k];
    while (piece->face.front() != chart.faces.front()) ++piece;  // it has no map
    chart.map = on_mesh(*chart.map, piece->mesh, unit, chart.pins);
    if (atlas.packing) atlas.packing->charts[k] = *chart.map;
    scale_points(unit, chart.pins);
    Stretch& s = chart.stretch;
    for (double* area : {&s.surface_area, &s.image_area, &s.square}) *area *= unit * unit;
  }
  const Stretch all = atlas.stretch();
  const double side = atlas.packing ? atlas.packing->side : std::sqrt(all.image_area);
  if (!is_in_range(all.surface_area) || !is_in_range(all.image_area) || !is_in_range(side))
    throw Error(ErrorKind::Unsupported,
                fmt::format("{}of some {:.0e} units, its areas or the side of its layout leave "
                            "the range of doubles; scale the mesh",
                            message_prefix(surface), unit));
}

// Returns the bounding box of the charts that are not stacked on another.
Eigen::AlignedBox2d box_around(const Atlas& atlas) {
  Eigen::AlignedBox2d box;
  for (const Chart& chart : atlas.charts) {
    if (chart.place) continue;
    const auto points = chart.map->control_points().reshaped(2, chart.map->space().node_count());
    box.extend(Eigen::AlignedBox2d(points.rowwise().minCoeff(), points.rowwise().maxCoeff()));
  }
  return box;
}

}  // namespace

bool exceeds_stretch(const UnwrapOptions& options, const Chart& chart) {
  return chart.stretch.l2 > options.cuts.max_stretch &&
         chart.map->mesh().rest_triangles().size() < chart.faces.size();
}

std::string why_stretched(const UnwrapOptions& options, const Chart& chart) {
  if (!is_stretched(options, chart)) return {};
  const bool is_stopped = chart.status != Status::Converged && chart.status != Status::Stalled;
  if (!is_stopped && chart.faces.size() == 1) return "it consists of one face";
  const auto& points = options.chart.map;
  if (!chart.pins.empty() || !points.handles.empty()) return "pins or handles hold it";
  return std::string(status_name(chart.status));
}

std::vector<BezierMap> maps_of(const Atlas& atlas) {
  std::vector<BezierMap> maps;
  for (const Chart& chart : atlas.charts) maps.push_back(*chart.map);
  return maps;
}

std::string_view start_name(ChartStart start) {
  constexpr std::array<std::string_view, 8> kNames = {
      "tutte",     "multiresolution", "parent",    "unfolded",
      "projected", "texture",         "untangled", "anew"};
  return kNames[static_cast<std::size_t>(start)];
}

Status worse_of(Status a, Status b) {
  // From the best to the worst.
  constexpr std::array kOrder = {Status::Converged, Status::Stalled,     Status::MaxIterations,
                                 Status::TimeLimit, Status::Interrupted, Status::Infeasible,
                                 Status::Failed};
  const auto rank = [&](Status s) { return std::find(kOrder.begin(), kOrder.end(), s); };
  return rank(a) < rank(b) ? b : a;
}

Status Atlas::status() const {
  Status worst = worse_of(unmapped.status, packed);
  for (const Chart& chart : charts) worst = worse_of(worst, chart.status);
  return worst;
}

std::string Atlas::message() const {
  const Status worst = status();
  for (const Chart& chart : charts)
    if (chart.status == worst && worst != Status::Converged) return chart.message;
  if (!is_complete())
    return fmt::format("{} of {} charts have no map yet", unmapped.count,
                       unmapped.count + static_cast<Index>(charts.size()));
  if (packed != Status::Converged)
    return "packing was stopped; charts have their first arrangement";
  return {};
}

double Atlas::value() const {
  double sum = 0, area = 0;
  for (const Chart& chart : charts) {
    sum += chart.stretch.surface_area * chart.measures.value;
    area += chart.stretch.surface_area;
  }
  return sum / area;
}

Stretch Atlas::stretch() const {
  Stretch all;
  for (const Chart& chart : charts) all = all.joined(chart.stretch);
  return all;
}

Atlas unwrap(const std::shared_ptr<const SurfaceMesh>& surface, const UnwrapOptions& options,
             RunRecord& record) {
  require_given("unwrap: the surface", surface);
  require_face_data(*surface, options.chart.map);
  const double unit = model_unit(*surface);
  if (unit == 1) return unwrap_usable(*surface, options, record);
  require_usable_sizes(*surface);
  UnwrapOptions scaled = options;
  scale_points(1 / unit, scaled.chart.map.pins);
  scale_points(1 / unit, scaled.chart.map.handles);
  if (scaled.packing && scaled.packing->side) *scaled.packing->side /= unit;
  Atlas atlas = unwrap_usable(*in_units(*surface, unit), scaled, record);
  to_model_units(*surface, unit, atlas);
  return atlas;
}

double layout_size(const Atlas& atlas) {
  const Eigen::AlignedBox2d box = box_around(atlas);
  return box.isEmpty() ? 0 : box.sizes().maxCoeff();
}

std::optional<double> clearance(const Chart& chart, double at_most) {
  const double found = border_clearance(*chart.map, {.at_least = at_most});
  return found < at_most ? std::optional(found) : std::nullopt;
}

std::string problem_in_unit_square(const Atlas& atlas) {
  const Eigen::AlignedBox2d box = box_around(atlas);
  const bool is_packed = atlas.packing.has_value();
  const LayoutMotion motion =
      unit_square_motions({1, 0}, is_packed ? atlas.packing->origin : Vector2(box.min()),
                          is_packed ? atlas.packing->side : box.sizes().maxCoeff())
          .front();
  for (const Chart& chart : atlas.charts) {
    if (chart.place) continue;
    const BezierMap moved = motion(*chart.map);
    if (!has_positive_determinants(moved))
      return "its smallest triangles are too small for doubles";
    const GlobalInjectivity proof = check_boundary(moved);
    if (proof.result != ProofStatus::Proven)
      return fmt::format(
          "the chart of face {} {}, since parts of its border have no room between them",
          chart.map->mesh().input_face(0) + 1, meeting_words(proof));
  }
  return "rounding brings its charts closer together than the padding";
}

std::optional<LayoutMotion> into_unit_square(Atlas& atlas) {
  std::vector<BezierMap> maps;
  std::vector<std::size_t> lowest;
  for (std::size_t k = 0; k < atlas.charts.size(); ++k) {
    if (atlas.charts[k].place) continue;
    maps.push_back(*atlas.charts[k].map);
    lowest.push_back(k);
  }
  const Eigen::AlignedBox2d box = box_around(atlas);
  Vector2 low = box.min();
  double side = box.sizes().maxCoeff();
  LayoutRequirements requirements{.simple_boundaries = true};
  if (atlas.packing) {
    low = atlas.packing->origin;
    side = atlas.packing->side;
    requirements.distance = atlas.packing->distance;
    for (const std::size_t k : lowest) requirements.fixed.push_back(!atlas.charts[k].pins.empty());
  }
  std::vector<LayoutMotion> attempts = unit_square_motions({1, 0}, low, side);
  if (atlas.packing && atlas.packing->has_tiles) {
    attempts.resize(1);  // with another size tiles would not be unit squares
    const double border = atlas.packing->border / side;
    for (const std::size_t k : lowest) {
      const Vector2 corner = tile_corner(atlas.packing->tiles[k]);
      requirements.boxes.emplace_back(corner.array() + border, corner.array() + (1 - border));
    }
  }
  std::optional<MovedLayout> moved = moved_layout(maps, attempts, requirements);
  if (!moved) return std::nullopt;
  for (std::size_t i = 0; i < lowest.size(); ++i)
    atlas.charts[lowest[i]].map = std::move(moved->maps[i]);
  for (Chart& chart : atlas.charts)
    if (chart.place)
      chart.map = map_on(*atlas.charts[chart.place->chart].map, *chart.map, *chart.place);
  return moved->motion;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
