#include "apps/report.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <numbers>

#include "majorant/io/atomic_file.h"

namespace majorant::app {

Json input_section(const PolygonMesh& polygons, const SurfaceMesh& mesh) {
  const Topology& t = mesh.topology();
  Json repairs = Json::array();
  const auto unused = static_cast<Index>(polygons.positions.size()) - mesh.vertex_count();
  if (unused > 0) repairs.push_back(fmt::format("{} unreferenced vertices left out", unused));
  if (mesh.face_count() != static_cast<Index>(polygons.polygons.size()))
    repairs.push_back(fmt::format("{} polygons triangulated into {} faces",
                                  polygons.polygons.size(), mesh.face_count()));
  return {{"file", polygons.file},
          {"vertices", t.vertices},
          {"faces", t.faces},
          {"components", t.components},
          {"boundary_loops", t.boundary_loops},
          {"euler_characteristic", t.euler_characteristic()},
          {"area", mesh.area()},
          {"repairs", repairs}};
}

Json measures_section(const BezierMap& map, const MapMeasures& m, const std::string& energy) {
  return {{"degree", map.degree()},
          {"control_points", map.space().node_count()},
          {"energy", energy},
          {"value", m.value},
          {"max_density", m.max_density},
          {"sigma_max", m.sigma_max},
          {"sigma_min", m.sigma_min},
          {"locally_injective", m.locally_injective},
          {"min_det_bound", m.min_det.minCoeff()},
          {"globally_injective", nullptr},
          {"seam_residual", map.seams().empty() ? Json() : Json(m.seam_residual)},
          {"max_boundary_angle_degrees", m.max_boundary_angle * 180 / std::numbers::pi},
          {"boundary_vertices_over_360_degrees", m.boundary_over_full_turn}};
}

Json iterations_section(const std::vector<TraceEntry>& trace) {
  Json list = Json::array();
  for (const TraceEntry& e : trace) {
    const IterationRecord& r = e.record;
    list.push_back({{"iteration", r.iteration},
                    {"degree", e.degree},
                    {"energy", r.energy},
                    {"relative_decrease", r.relative_decrease},
                    {"step", r.step},
                    {"step_bound", r.step_bound},
                    {"gradient_norm", r.gradient_norm},
                    {"newton_decrement", r.newton_decrement},
                    {"shift", r.shift},
                    {"trials", r.trials},
                    {"seconds",
                     {{"assemble", r.seconds.assemble},
                      {"factorize", r.seconds.factorize},
                      {"solve", r.seconds.solve},
                      {"line_search", r.seconds.line_search}}}});
  }
  return list;
}

long peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss * 1024L;
}

void write_json(const std::string& path, const Json& json) {
  write_file_atomically(path, json.dump(1) + "\n");
}

void write_trace(const std::string& path, const std::vector<TraceEntry>& trace) {
  std::string out =
      "iteration,degree,energy,relative_decrease,step,step_bound,gradient_norm,newton_decrement,"
      "shift,trials,assemble,factorize,solve,line_search\n";
  for (const TraceEntry& e : trace) {
    const IterationRecord& r = e.record;
    out += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", r.iteration, e.degree,
                       r.energy, r.relative_decrease, r.step, r.step_bound, r.gradient_norm,
                       r.newton_decrement, r.shift, r.trials, r.seconds.assemble,
                       r.seconds.factorize, r.seconds.solve, r.seconds.line_search);
  }
  write_file_atomically(path, out);
}

}  // namespace majorant::app
