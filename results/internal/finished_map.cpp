#include "majorant/results/internal/finished_map.h"

#include <utility>

#include "majorant/certify/cut_map.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/framework/thread_count.h"
#include "majorant/io/map_distortion.h"
#include "majorant/results/internal/global_verdict.h"
#include "majorant/results/internal/write_map.h"

namespace majorant {
namespace {

Json aligned_section(const FinishedMap& run) {
  if (!run.placement || !run.is_aligned) return nullptr;
  const Vector2& direction = run.placement->direction;
  return {{"direction", {direction.x(), direction.y()}}};
}

Json normalized_section(const FinishedMap& run) {
  if (!run.placement || !run.is_normalized) return nullptr;
  const LayoutMotion& p = *run.placement;
  return {{"origin", {p.origin.x(), p.origin.y()}}, {"size", p.size}};
}

// What the start was made from: where nobody brought one, what parametrize() chose.
std::string_view start_taken(const FinishedMap& run) {
  if (run.result.start != StartMethod::Given) return start_name(run.result.start);
  // Seams of texture coordinates need not be asked for twice.
  return run.init == start_name(StartMethod::Automatic) ? start_name(StartMethod::Given)
                                                        : std::string_view(run.init);
}

std::string claims(const FinishedMap& run, const MapFile& file) {
  const BezierMap& map = *run.result.map;
  Json pins = Json::array();
  for (const Pin& pin : run.asked.pins) {
    const Vector2 uv = map.control_points().segment<2>(2 * pin.vertex);
    pins.push_back({{"vertex", map.mesh().input_vertex(pin.vertex)}, {"target", {uv.x(), uv.y()}}});
  }
  Json claims{{"version", MAJORANT_VERSION},
              {"degree", run.asked.degree},
              {"energy", run.energy},
              {"value", run.result.measures.value},
              {"boundary", run.asked.boundary == BoundaryCondition::Fixed ? "fixed" : "free"},
              {"init", start_taken(run)},
              {"seams", !map.seams().trivial()},
              {"bijective", run.asked.injectivity == MapInjectivity::Global},
              {"aligned", aligned_section(run)},
              {"normalized", normalized_section(run)},
              {"pins", pins},
              {"other_triangles", run.result.other_triangles},
              {"cuts", unshared_edges(file, run.polygons.file)},
              {"options", run.options}};
  if (run.result.measures.cut_short) claims.erase("value");  // not good enough to be claimed
  if (run.energy.empty()) {                                  // nobody else could tell
    claims.erase("energy");
    claims.erase("value");
  }
  if (!map.seams().trivial()) claims["cones"] = cones_section(map);
  return json_text(without_folders(std::move(claims)));
}

Json result_section(const FinishedMap& run) {
  const ParametrizationResult& r = run.result;
  if (!r.map) return nullptr;
  Json result = measures_section(*r.map, r.measures, run.energy);
  if (!r.measures.cut_short)
    result["distortion"] = distortion_section({&r.measures.distortion}, scale_of(run));
  add_global_injectivity(result, *r.map, r.measures, run.boundary);
  result["start"] = start_taken(run);
  result["variables"] = r.variables;
  result["initial_value"] = r.initial_value;
  result["value_quadrature"] = r.value_quadrature;
  result["newton_decrement"] = r.newton_decrement;
  result["constraint_residual"] = r.constraint_residual;
  result["handle_distance"] = r.handle_distance;
  result["factor_solve_seconds"] = r.factor_solve_seconds ? Json(*r.factor_solve_seconds) : Json();
  if (run.cuts) result.update(cuts_section(*run.cuts, run.mesh.area()));
  return result;
}

Json seam_start_section(const Start& start) {
  const Seams& seams = start.map.seams();
  return {{"residual", start.residual},    {"moved", start.moved},
          {"inverted", start.inverted},    {"untangling_steps", start.untangling_steps},
          {"chains", seams.chain_count()}, {"seam_edges", seams.edges().size()}};
}

}  // namespace

bool has_result(const ParametrizationResult& result) {
  return result.map && result.status != Status::Failed && result.status != Status::Infeasible;
}

GlobalInjectivity prove_boundary(const ParametrizationResult& result, const RunRecord& record) {
  if (!result.map) return {};
  if (result.boundary) return *result.boundary;
  record.begin(Activity::Proving);
  return check_boundary(*result.map);
}

double scale_of(const FinishedMap& run) { return run.placement ? run.placement->size : 1; }

ProofRequest promise(const FinishedMap& run, const std::string& path) {
  ProofRequest promise;
  promise.surface = &run.polygons;
  if (!run.result.map->seams().trivial()) promise.cuts = CutRule::Seams;
  if (run.cuts) promise.cuts = CutRule::Free;
  if (run.asked.injectivity == MapInjectivity::Global)
    promise.overlap = ProofRequest::Overlap::Forbidden;
  promise.labels = labels_in(path);
  return promise;
}

MapFile map_file(const FinishedMap& run) {
  MapFile file = to_map_file(*run.result.map);
  // Of an energy without a name nobody else could tell.
  if (!run.result.measures.cut_short && !run.energy.empty())
    file.distortion = run.result.measures.face_value;
  file.min_det = run.result.measures.min_det;
  file.face_distortion = finite_or_none(run.result.measures.distortion.faces);
  file.claims = claims(run, file);
  return file;
}

Json map_report(const FinishedMap& run) {
  const ParametrizationResult& r = run.result;
  Json report{{"schema_version", 1},
              {"version", MAJORANT_VERSION},
              {"command", run.command},
              {"status", status_name(r.status)},
              {"message", r.message},
              {"warnings", run.polygons.warnings},
              {"input", input_section(run.polygons, run.mesh)},
              {"options", run.options},
              {"result", result_section(run)},
              {"outputs", nullptr},
              {"iterations", iterations_section(run.record.trace())},
              {"injectivity_tests", {{"depth", r.injectivity_tests}}},
              {"remedies", remedies_section(r.remedies)},
              {"flips", {{"intended", r.flips.intended}, {"performed", r.flips.performed}}},
              {"seconds",
               {{"read", run.read_seconds},
                {"initialize", r.initialize_seconds},
                {"optimize", r.optimize_seconds},
                {"scaffold", r.scaffold_seconds},
                {"measure", r.measure_seconds},
                {"write", nullptr},
                {"total", nullptr}}},
              {"linear_solver", run.linear_solver},
              {"memory", run.memory},
              {"peak_memory_bytes", peak_memory_bytes()},
              {"threads", ThreadCount::current()},
              {"vector_instructions", vector_instructions()}};
  if (run.start && !run.start->map.seams().trivial())
    report["seam_start"] = seam_start_section(*run.start);
  if (run.film)
    report["snapshots"] = {{"every", run.film->every()},
                           {"frames", run.film->count(last_iteration(run.record.trace()))}};
  return report;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
