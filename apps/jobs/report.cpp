#include "majorant/apps/jobs/report.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "majorant/certify/map_proof.h"
#include "majorant/framework/energy_term.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/rounding.h"
#include "majorant/io/atomic_file.h"
#include "majorant/mesh/geometry.h"

namespace majorant {

Json to_json(const RunReport& report, const Json& outputs) {
  Json json{{"schema_version", 2},
            {"version", MAJORANT_VERSION},
            {"command", report.command},
            {"status", report.status},
            {"message", report.message},
            {"input", report.input},
            {"options", report.options},
            {"outputs", outputs},
            {"seconds", report.seconds},
            {"warnings", report.warnings},
            {"threads", ThreadCount::current()},
            {"peak_memory_bytes", peak_memory_bytes()},
            {"result", report.result}};
  json.update(report.more);
  return json;
}

Json input_section(const PolygonMesh& polygons, const SurfaceMesh& mesh) {
  const Topology& t = mesh.topology();
  Json repairs = Json::array();
  const auto unused = static_cast<Index>(polygons.positions.size()) - mesh.vertex_count();
  if (unused > 0)
    repairs.push_back(
        fmt::format("{} unreferenced {} left out", unused, unused == 1 ? "vertex" : "vertices"));
  if (mesh.face_count() != static_cast<Index>(polygons.polygons.size()))
    repairs.push_back(
        fmt::format("{} triangulated into {}",
                    count_text(static_cast<Index>(polygons.polygons.size()), "polygon"),
                    count_text(mesh.face_count(), "face")));
  Json section{{"file", polygons.file},
               {"vertices", t.vertices},
               {"faces", t.faces},
               {"components", t.components},
               {"boundary_loops", t.boundary_loops},
               {"euler_characteristic", t.euler_characteristic()},
               {"area", mesh.area()},
               {"repairs", repairs},
               {"warnings", polygons.warnings}};
  if (polygons.faces_missing > 0) section["faces_missing"] = polygons.faces_missing;
  return section;
}

Json cones_section(const BezierMap& map) {
  Json list = Json::array();
  for (const Cone& cone : map.seams().cones())  // a vertex keeps its number on the cut surface
    list.push_back({{"vertex", map.mesh().input_vertex(cone.vertex)},
                    {"quarter_turns", cone.quarter_turns},
                    {"index", (4 - cone.quarter_turns) / 4.0}});
  return list;
}

namespace {

// Returns the residual in units of the rounding error of coordinates as large as the layout.
double seam_residual_ulp(const BezierMap& map, double seam_residual) {
  return seam_residual / (2 * kUnitRoundoff<double> * extent(map.control_uv()));
}

}  // namespace

Json measures_section(const MapSize& size, const MapMeasures& m, double least_det,
                      const std::string& energy) {
  return {{"degree", size.degree},
          {"control_points", size.control_points},
          {"energy", energy},
          {"value", m.value},
          {"measuring_cut_short", m.cut_short},
          {"max_density", m.max_density},
          {"sigma_max", m.sigma_max},
          {"sigma_min", m.sigma_min},
          {"locally_injective", m.locally_injective},
          {"min_det_bound", least_det},
          {"globally_injective", nullptr},
          {"overlaps", "not decided: stopped before they were looked for"},
          {"seam_residual", nullptr},
          {"max_boundary_angle_degrees", m.max_boundary_angle * 180 / std::numbers::pi},
          {"boundary_vertices_over_360_degrees", m.boundary_over_full_turn}};
}

Json measures_section(const BezierMap& map, const MapMeasures& m, const std::string& energy) {
  Json section =
      measures_section({map.degree(), map.space().node_count()}, m, m.min_det.minCoeff(), energy);
  if (map.seams().trivial()) return section;
  section["seam_residual"] = m.seam_residual;
  section["seam_residual_ulp"] = seam_residual_ulp(map, m.seam_residual);
  section["cones"] = cones_section(map);
  return section;
}

namespace {

Json spread_section(const Spread& spread) {
  Json section{{"mean", spread.mean}};
  for (std::size_t k = 0; k < kPercentiles.size(); ++k)
    section[fmt::format("p{}", kPercentiles[k])] = spread.percentile[k];
  return section;
}

}  // namespace

Json distortion_section(const std::vector<const MapDistortion*>& parts, double scale) {
  const DistortionSummary all = summary(parts);
  return {{"scale", scale},
          {"stretch_l2", all.stretch_l2},
          {"stretch_linf", all.stretch_linf},
          {"sigma_1", spread_section(all.sigma_1)},
          {"sigma_2", spread_section(all.sigma_2)},
          {"area", spread_section(all.area)},
          {"angle", spread_section(all.angle)}};
}

Json cuts_section(const SurfaceCuts& cuts, double area) {
  return {{"seam_length", cuts.length},
          {"seam_length_relative", cuts.length / std::sqrt(area)},
          {"seam_edges", cuts.edges},
          {"added_seam_length", cuts.added_length},
          {"added_seam_edges", cuts.added_edges},
          {"untextured_faces", cuts.untextured_faces}};
}

Json cuts_section(const SurfaceCuts& cuts, const RepairedSurface& surface) {
  const double area = surface.mesh->area();
  Json section = cuts_section(cuts, area);
  section["seam_length"] = cuts.length + surface.cut_length;
  section["seam_length_relative"] = (cuts.length + surface.cut_length) / std::sqrt(area);
  section["seam_edges"] = cuts.edges + surface.cut_edges;
  section["repair_seam_length"] = surface.cut_length;
  section["repair_seam_edges"] = surface.cut_edges;
  return section;
}

std::string seam_summary(const Json& measures_section) {
  if (!measures_section.contains("cones")) return {};
  return fmt::format(", {}, seams fit to {:.1g} ({:.1f} ulp of the layout)",
                     count_text(static_cast<Index>(measures_section["cones"].size()), "cone"),
                     measures_section["seam_residual"].get<double>(),
                     measures_section["seam_residual_ulp"].get<double>());
}

Json remedies_section(const RemedyUses& uses) {
  Json section = Json::object();
  for (std::size_t k = 0; k < kRemedies.size(); ++k)
    section[remedy_name(kRemedies[k])] = {{"runs", uses[k].runs}, {"gained", uses[k].gained}};
  return section;
}

namespace {

std::string_view remedy_of(const TraceEntry& entry) {
  return entry.remedy ? remedy_name(*entry.remedy) : std::string_view();
}

}  // namespace

Json iterations_section(const std::vector<TraceEntry>& trace) {
  Json list = Json::array();
  for (const TraceEntry& e : trace) {
    const IterationRecord& r = e.record;
    list.push_back({{"iteration", r.iteration},
                    {"degree", e.degree},
                    {"phase", phase_name(e.phase)},
                    {"remedy", e.remedy ? Json(remedy_of(e)) : Json()},
                    {"level", e.level},
                    {"outcome", outcome_name(e.outcome)},
                    {"energy", e.energy},
                    {"minimized", r.energy},
                    {"relative_decrease", r.relative_decrease},
                    {"step", r.step},
                    {"step_bound", r.step_bound},
                    {"gradient_norm", r.gradient_norm},
                    {"newton_decrement", r.newton_decrement},
                    {"curvature", curvature_name(r.curvature)},
                    {"projection_weight", r.projection_weight},
                    {"limit", limit_name(r.limit)},
                    {"shift", r.shift},
                    {"factorizations", r.factorizations},
                    {"failed_factorizations", r.failed_factorizations},
                    {"residual", r.residual},
                    {"solver_iterations", r.solver_iterations},
                    {"trials", r.trials},
                    {"elapsed", e.elapsed},
                    {"seconds",
                     {{"assemble", r.seconds.assemble},
                      {"factorize", r.seconds.factorize},
                      {"solve", r.seconds.solve},
                      {"line_search", r.seconds.line_search},
                      {"other", e.other_seconds}}}});
  }
  return list;
}

long peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss * 1024L;
}

void add_solver(RunReport& report, const Json& linear_solver, const Json& memory) {
  report.more["linear_solver"] = linear_solver;
  report.more["memory"] = memory;
  report.more["vector_instructions"] = vector_instructions();
}

namespace {

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

void replace_all(std::string& text, const std::string& path) {
  const std::string name = file_name(path);
  for (std::size_t k = text.find(path); k != std::string::npos;
       k = text.find(path, k + name.size()))
    text.replace(k, path.size(), name);
}

void add_paths(const Json& options, std::vector<std::string>& paths) {
  for (const Json& option : options)
    if (option.is_string() && option.get_ref<const std::string&>().find('/') != std::string::npos)
      paths.push_back(option);
}

void shorten(Json& json, const std::vector<std::string>& paths) {
  if (json.is_structured())
    for (Json& part : json) shorten(part, paths);
  if (json.is_string())
    for (const std::string& path : paths) replace_all(json.get_ref<std::string&>(), path);
}

}  // namespace

Json without_folders(Json json, const std::vector<std::string>& paths) {
  std::vector<std::string> all = paths;
  if (json.contains("options")) add_paths(json["options"], all);
  std::erase_if(all, [](const std::string& path) { return file_name(path).empty(); });
  // Longer paths come first, since one may be the end of another.
  std::sort(all.begin(), all.end(),
            [](const std::string& a, const std::string& b) { return a.size() > b.size(); });
  shorten(json, all);
  return json;
}

std::string json_text(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

void write_trace(const std::string& path, const std::vector<TraceEntry>& trace) {
  std::string out =
      "iteration,degree,energy,relative_decrease,step,step_bound,gradient_norm,newton_decrement,"
      "shift,trials,assemble,factorize,solve,line_search,phase,remedy,level,outcome,minimized,"
      "curvature,factorizations,failed_factorizations,other,elapsed,residual,solver_iterations,"
      "projection_weight,limit\n";
  for (const TraceEntry& e : trace) {
    const IterationRecord& r = e.record;
    out += fmt::format("{},{},{},{},{},{},{},{},{},{},", r.iteration, e.degree, e.energy,
                       r.relative_decrease, r.step, r.step_bound, r.gradient_norm,
                       r.newton_decrement, r.shift, r.trials);
    out += fmt::format("{},{},{},{},{},{},", r.seconds.assemble, r.seconds.factorize,
                       r.seconds.solve, r.seconds.line_search, phase_name(e.phase), remedy_of(e));
    out += fmt::format("{},{},{},{},{},{},{},{},{},{},", e.level, outcome_name(e.outcome), r.energy,
                       curvature_name(r.curvature), r.factorizations, r.failed_factorizations,
                       e.other_seconds, e.elapsed, r.residual, r.solver_iterations);
    out += fmt::format("{},{}\n", r.projection_weight, limit_name(r.limit));
  }
  write_file_atomically(path, out);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
