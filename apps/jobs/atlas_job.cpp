#include "majorant/apps/jobs/atlas_job.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "majorant/apps/jobs/corner_vertices.h"
#include "majorant/apps/jobs/global_verdict.h"
#include "majorant/apps/jobs/write_map.h"
#include "majorant/certify/boundary_loops.h"
#include "majorant/certify/cut_map.h"
#include "majorant/framework/stopwatch.h"
#include "majorant/io/io.h"
#include "majorant/maps/rest_shapes_of.h"
#include "majorant/mesh/marked_creases.h"
#include "majorant/mesh/weld.h"
#include "majorant/parametrization/seams/cut_paths.h"
#include "majorant/parametrization/seams/visibility.h"

namespace majorant {
namespace {

// The progress of cutting that is reported once visibilities are known.
constexpr double kLookedShare = 0.05;

bool is_cut_short(const Atlas& atlas) {
  return std::any_of(atlas.charts.begin(), atlas.charts.end(),
                     [](const Chart& chart) { return chart.measures.cut_short; });
}

// Returns whether the surface has faces without area. They are measured against shapes that the
// file does not contain.
bool is_measured_anew(const AtlasJob& job) {
  return !is_cut_short(job.atlas) && job.surface.mesh->rest_triangles().empty();
}

Json normalized_section(const std::optional<LayoutMotion>& square) {
  if (!square) return nullptr;
  return {{"origin", {square->origin.x(), square->origin.y()}}, {"size", square->size}};
}

Json pins_section(const AtlasJob& job) {
  Json pins = Json::array();
  for (const Chart& chart : job.atlas.charts)
    for (const Pin& pin : chart.pins) {
      const Vector2 uv = chart.map->control_points().segment<2>(2 * pin.vertex);
      pins.push_back(
          {{"vertex", chart.map->mesh().input_vertex(pin.vertex)}, {"target", {uv.x(), uv.y()}}});
    }
  return pins;
}

bool is_mirrored(const Chart& chart) {
  return chart.place && chart.place->sense == ChartSense::Mirrored;
}

// Returns the number of the stack of each chart, in the order of the lowest charts; -1: the chart
// is in no stack.
std::vector<int> stacks_of(const Atlas& atlas) {
  std::vector<int> stack(atlas.charts.size(), -1);
  for (const Chart& chart : atlas.charts)
    if (chart.place) stack[chart.place->chart] = 0;
  int count = 0;
  for (int& number : stack)
    if (number == 0) number = count++;
  for (std::size_t k = 0; k < stack.size(); ++k)
    if (atlas.charts[k].place) stack[k] = stack[atlas.charts[k].place->chart];
  return stack;
}

Json stacks_section(const Atlas& atlas) {
  const std::vector<int> stack = stacks_of(atlas);
  Json stacks = Json::array();
  for (std::size_t k = 0; k < stack.size(); ++k) {
    if (stack[k] < 0) continue;
    if (to_size(stack[k]) == stacks.size())
      stacks.push_back({{"charts", Json::array()}, {"mirrored", Json::array()}});
    stacks[to_size(stack[k])]["charts"].push_back(k);
    if (is_mirrored(atlas.charts[k])) stacks[to_size(stack[k])]["mirrored"].push_back(k);
  }
  return stacks;
}

// Returns the file with one point for each vertex of the input, as files that name vertices need.
MapFile as_input(const MapFile& file, const PolygonMesh& polygons) {
  return with_corner_vertices(file, polygons).value_or(file);
}

// Returns flags of the input's polygons: those that have a face without a map.
std::vector<char> unmapped_polygons(const AtlasJob& job) {
  std::vector<char> flags(job.polygons->polygons.size(), 0);
  for (const Index face : job.atlas.unmapped.faces)
    flags[to_size(job.surface.mesh->input_face(face))] = 1;
  return flags;
}

// Removes the cells of polygons that have a map only in part, because files describe whole
// polygons.
MapFile of_whole_polygons(const AtlasJob& job, const MapFile& file) {
  const std::vector<char> unmapped = unmapped_polygons(job);
  std::vector<Index> cells;
  for (Index c = 0; c < file.cells.rows(); ++c)
    if (!unmapped[to_size(file.input_face[c])]) cells.push_back(c);
  return cells.size() == to_size(static_cast<Index>(file.cells.rows())) ? file
                                                                        : with_cells(file, cells);
}

// Returns whether the file has a cell for every face of the charts, so that values of the charts
// are values of the file.
bool has_all_faces(const Atlas& atlas, const MapFile& file) {
  std::size_t faces = 0;
  for (const Chart& chart : atlas.charts) faces += chart.faces.size();
  return to_size(static_cast<Index>(file.cells.rows())) == faces;
}

std::string claims(const AtlasJob& job, const MapFile& file) {
  Json claims{{"version", MAJORANT_VERSION},
              {"degree", job.options.chart.map.degree},
              {"energy", job.energy},
              {"value", job.atlas.value()},
              {"boundary", "free"},
              {"seams", false},
              {"bijective", job.atlas.packing.has_value()},
              {"normalized", normalized_section(job.square)},
              {"layout_scale", 1 / scale_of(job)},
              {"pins", pins_section(job)},
              {"other_triangles", false},
              {"cuts", unshared_edges(as_input(file, *job.polygons), job.polygons->file)},
              {"options", job.options_json}};
  if (job.options.stacking != Stacking::None) claims["stacks"] = stacks_section(job.atlas);
  if (!job.atlas.is_complete()) claims["complete"] = false;
  if (!is_measured_anew(job) || !has_all_faces(job.atlas, file)) claims.erase("value");
  if (job.energy.empty()) {  // the file cannot name the energy
    claims.erase("energy");
    claims.erase("value");
  }
  return json_text(without_folders(std::move(claims)));
}

// Clearances above this part of the layout's size are not reported.
constexpr double kReportedClearance = 1.0 / 1024;

Json charts_section(const Atlas& atlas) {
  Json list = Json::array();
  const double reported = kReportedClearance * layout_size(atlas);
  const std::vector<int> stack = stacks_of(atlas);
  for (std::size_t k = 0; k < atlas.charts.size(); ++k) {
    const Chart& chart = atlas.charts[k];
    list.push_back({{"faces", chart.faces.size()},
                    {"area", chart.stretch.surface_area},
                    {"boundary_loops", chart.map->mesh().topology().boundary_loops},
                    {"start", start_name(chart.start)},
                    {"status", status_name(chart.status)},
                    {"message", chart.message},
                    {"iterations", steps_taken(chart.trace)},
                    {"value", chart.measures.value},
                    {"stretch_l2", chart.stretch.l2},
                    {"stretch_max", chart.stretch.max},
                    {"pinned", !chart.pins.empty()},
                    {"tile", nullptr},
                    {"stack", stack[k] < 0 ? Json() : Json(stack[k])},
                    {"mirrored", is_mirrored(chart)},
                    {"clearance", nullptr}});
    if (const std::optional<double> least = clearance(chart, reported))
      list.back()["clearance"] = *least;
    if (atlas.packing) list.back()["tile"] = udim(atlas.packing->tiles[k]);
  }
  return list;
}

Json repairs_section(const RepairedSurface& surface) {
  Json list = Json::array();
  for (const Repair& r : surface.repairs) {
    Json places = Json::array();
    for (const auto& [a, b] : r.places) places.push_back(b < 0 ? Json(a) : Json{a, b});
    list.push_back({{"kind", name_of(r.kind)},
                    {"count", r.count},
                    {"places", places},
                    {"message", describe(r)}});
    if (r.pieces) list.back()["pieces"] = {{"before", (*r.pieces)[0]}, {"after", (*r.pieces)[1]}};
  }
  return list;
}

Json result_section(const AtlasJob& job) {
  const Atlas& atlas = job.atlas;
  const Stretch stretch = atlas.stretch();
  MapMeasures all;
  all.sigma_min = INFINITY;
  all.locally_injective = true;
  double min_det = INFINITY;
  Index points = 0;
  std::vector<const MapDistortion*> distortions;
  for (const Chart& chart : atlas.charts) {
    all.max_density = std::max(all.max_density, chart.measures.max_density);
    all.sigma_max = std::max(all.sigma_max, chart.measures.sigma_max);
    all.sigma_min = std::min(all.sigma_min, chart.measures.sigma_min);
    min_det = std::min(min_det, chart.measures.min_det.minCoeff());
    all.locally_injective = all.locally_injective && chart.measures.locally_injective;
    points += chart.map->space().node_count();
    distortions.push_back(&chart.measures.distortion);
  }
  Json result{{"degree", job.options.chart.map.degree},
              {"control_points", points},
              {"energy", job.energy},
              {"value", atlas.value()},
              {"measuring_cut_short", is_cut_short(atlas)},
              {"max_density", all.max_density},
              {"sigma_max", all.sigma_max},
              {"sigma_min", all.sigma_min},
              {"locally_injective", all.locally_injective},
              {"min_det_bound", min_det},
              {"layout_scale", 1 / scale_of(job)},
              {"charts", atlas.charts.size()},
              {"complete", atlas.is_complete()},
              {"stretch_l2", stretch.l2},
              {"stretch_max", stretch.max}};
  result.update(overlap_section(job.boundary, ImageOf::Charts, all));
  if (!is_cut_short(atlas)) result["distortion"] = distortion_section(distortions, scale_of(job));
  result.update(cuts_section(atlas.cuts, job.surface));
  const CutTurning turning = turning_of_cuts(*job.surface.mesh, atlas.cuts.is_cut);
  result["seam_turning"] = {{"seams", turning.cuts}, {"shortest_paths", turning.shortest}};
  result["seam_visibility"] = nullptr;
  if (job.visibility.size() > 0)
    result["seam_visibility"] =
        visibility_of_cuts(*job.surface.mesh, job.visibility, atlas.cuts.is_cut);
  if (!atlas.packing) return result;
  result["fill"] = atlas.packing->fill;
  result["tiles"] = std::set<int>(atlas.packing->tiles.begin(), atlas.packing->tiles.end()).size();
  result["texel_density"] = *texel_density(job);
  result["side"] = atlas.packing->side;
  result["distance"] = atlas.packing->distance;
  result["packing"] = name_of(atlas.packing->method);
  return result;
}

}  // namespace

void AtlasJob::open(PolygonMesh input, const RepairOptions& repairs) {
  record.announce("building the surface");
  surface = repair(input, repairs, record.start_stop());
  is_joined_for_map_ = !repairs.weld && !is_soup(input);
  polygons = std::make_shared<PolygonMesh>(with_welded_vertices(std::move(input), surface));
}

const Repair* AtlasJob::first_repair() const {
  for (const Repair& r : surface.repairs)
    if (r.kind != RepairKind::MovedToOrigin &&
        !(r.kind == RepairKind::Welded && is_joined_for_map_))
      return &r;
  return nullptr;
}

void AtlasJob::solve() {
  record.begin(Activity::Cutting);
  options.cuts.given.clear();
  if (old_seams == OldSeams::Cut) options.cuts.given = surface.texture_seams;
  options.cuts.preferences = {marked_creases(*polygons, surface), {}};
  if (chooses_cuts(options.cuts.method)) {
    const AddedSeconds time(visibility_seconds);
    const StopCheck stop = record.telling(record.start_stop()).between(0, kLookedShare);
    visibility = hide_from ? visibility_from(*surface.mesh, *hide_from, stop)
                           : ambient_visibility(*surface.mesh, stop);
    options.cuts.preferences.weight = hiding_weights(*surface.mesh, visibility);
  }
  if (!texel_density.empty()) ask_for_density();
  atlas = unwrap(surface.mesh, options, record);
}

// Scales each chart by its density relative to an isometry, and all together to the size of the
// surface.
void AtlasJob::ask_for_density() {
  const SurfaceMesh& mesh = *surface.mesh;
  Vec density(mesh.face_count());
  for (Index f = 0; f < mesh.face_count(); ++f) density[f] = texel_density[mesh.input_face(f)];
  const Vec area = rest_shapes(mesh).measure;
  // Squares of very large or small densities would leave the range of doubles.
  const double most = density.maxCoeff();
  const double mean = most * std::sqrt(area.dot((density / most).cwiseAbs2()) / area.sum());
  options.packing->side = options.packing->resolution / mean;
  options.face_scale = Vec();
  if (density.minCoeff() == density.maxCoeff()) return;
  options.face_scale = density / mean;
  options.cuts.given.resize(to_size(mesh.half_edge_count()), 0);
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Index other = mesh.opposite(h);
    if (other >= 0 && density[face_of(h)] != density[face_of(other)])
      options.cuts.given[h] = options.cuts.given[other] = 1;
  }
}

bool AtlasJob::place() {
  square = into_unit_square(atlas);
  return square.has_value();
}

void AtlasJob::prove() {
  record.begin(Activity::Proving);
  if (atlas.packing) {
    boundary.result = ProofStatus::Proven;  // at proven distances
    return;
  }
  BoundaryLoops layout;
  Index faces = 0;
  for (const Chart& chart : atlas.charts) {
    const BoundaryLoops loops = boundary_loops(*chart.map);
    for (const BoundaryLoop& loop : loops.loops) {
      const auto begin = static_cast<std::ptrdiff_t>(loop.first), end = std::ptrdiff_t{loop.last};
      std::vector<Index> half_edges(loops.half_edge.begin() + begin, loops.half_edge.begin() + end);
      for (Index& h : half_edges) h += 3 * faces;
      layout.add_loop(layout.charts + loop.chart,
                      {loops.curves.begin() + begin, loops.curves.begin() + end}, half_edges);
    }
    layout.charts += loops.charts;
    faces += chart.map->mesh().face_count();
  }
  boundary = check_layout(layout);
}

double scale_of(const AtlasJob& job) { return job.square ? job.square->size : 1; }

std::optional<double> texel_density(const AtlasJob& job) {
  if (!job.atlas.packing) return std::nullopt;
  const double side = job.square ? job.square->size : job.atlas.packing->side;
  const Stretch all = job.atlas.stretch();
  const double larger = all.surface_area > 0 ? std::sqrt(all.image_area / all.surface_area) : 1;
  return job.options.packing->resolution / side * larger;
}

double seam_length(const AtlasJob& job) { return job.atlas.cuts.length + job.surface.cut_length; }

MapFile atlas_file(const AtlasJob& job, FaceDistortion* table) {
  std::vector<MapFile> charts;
  for (const Chart& chart : job.atlas.charts) {
    MapFile& file = charts.emplace_back(to_map_file(*chart.map));
    if (is_mirrored(chart)) file.uv.col(0) *= -1;
    if (is_measured_anew(job) && !job.energy.empty())  // readers cannot measure an energy without a
                                                       // name
      file.distortion = chart.measures.face_value;
    if (is_measured_anew(job)) file.min_det = chart.measures.min_det;
    file.face_distortion = chart.measures.cut_short
                               ? measure_distortion(*chart.map, scale_of(job)).faces
                               : chart.measures.distortion.faces;
  }
  MapFile file = joined(charts);
  if (!job.atlas.is_complete()) {
    file = of_whole_polygons(job, file);
    file.is_complete = false;
  }
  file.claims = claims(job, file);
  if (table) *table = file.face_distortion;
  file.face_distortion =
      is_measured_anew(job) ? finite_or_none(file.face_distortion) : FaceDistortion();
  return file;
}

ProofRequest proof_request(const AtlasJob& job, const std::string& path) {
  ProofRequest request;
  request.surface = job.polygons.get();
  request.labels = labels_in(path);
  request.cuts = CutRule::Free;
  if (!job.atlas.is_complete()) {
    const std::vector<char> unmapped = unmapped_polygons(job);
    request.coverage = ProofRequest::Coverage::Partial;
    request.unmapped = static_cast<Index>(std::count(unmapped.begin(), unmapped.end(), 1));
  }
  if (job.atlas.packing) request.overlap = ProofRequest::Overlap::Forbidden;
  if (job.options.stacking != Stacking::None) request.stacks = ProofRequest::Stacks::Allowed;
  return request;
}

RunReport atlas_report(const AtlasJob& job) {
  const Atlas& atlas = job.atlas;
  RunReport report{.command = "unwrap",
                   .status = std::string(status_name(atlas.status())),
                   .message = atlas.message(),
                   .input = input_section(*job.polygons, *job.surface.mesh),
                   .options = job.options_json,
                   .result = result_section(job),
                   .warnings = job.polygons->warnings,
                   .seconds = {{"read", job.read_seconds},
                               {"cut", job.visibility_seconds + atlas.seconds.cut},
                               {"recut", atlas.seconds.recut},
                               {"map", atlas.seconds.map},
                               {"pack", atlas.seconds.pack}}};
  report.more = {{"repairs", repairs_section(job.surface)}, {"charts", charts_section(atlas)}};
  add_solver(report, job.linear_solver, job.memory);
  return report;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
