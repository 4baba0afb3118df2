// The solvers of maps.
#include <pybind11/stl.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "arrays.h"
#include "majorant/apps/jobs/input_points.h"
#include "majorant/apps/jobs/map_job.h"
#include "majorant/apps/jobs/petsc_fallback.h"
#include "majorant/framework/error.h"
#include "majorant/parametrization/initialization/start.h"
#include "majorant/parametrization/solve/map_sensitivity.h"
#include "map_file.h"
#include "mesh.h"
#include "module.h"
#include "options.h"
#include "run.h"

namespace majorant::python {
namespace {

// A MapJob with its run and its keywords.
struct PythonJob {
  PythonJob(MapTask task, SharedPolygons polygons_, py::dict wishes_, const py::object& callback)
      : polygons(std::move(polygons_)),
        keywords(std::move(wishes_)),
        run(keyword<double>(keywords, "time_limit"), keyword<int>(keywords, "max_iterations"),
            callback),
        job(task, run.record()) {
    job.energy = keyword<std::string>(keywords, "energy_text");
    job.init = keyword<std::string>(keywords, "init");
    job.options_json = Json::parse(keyword<std::string>(keywords, "as_json"));
    job.linear_solver = linear_solver_section("direct", OwnSolver::Used, {});
  }

  SharedPolygons polygons;
  py::dict keywords;
  Run run;
  MapJob job;
};

// Throws Error if the job has no map.
void require_result(const MapJob& job) {
  if (job.has_result()) return;
  const ParametrizationResult& result = job.result;
  const bool is_infeasible = result.status == Status::Infeasible;
  throw Error(is_infeasible ? ErrorKind::Infeasible : ErrorKind::Invalid,
              "no valid map: " + std::string(status_name(result.status)) +
                  (result.message.empty() ? "" : ", " + result.message));
}

// The result of a run, with the data for derivatives of its map.
struct SolvedMap {
  ParametrizationResult result;
  ParametrizationOptions options;
};

std::shared_ptr<SolvedMap> solved_map(const MapJob& job) {
  auto kept = std::make_shared<SolvedMap>();
  kept->result.status = job.result.status;
  kept->result.message = job.result.message;
  kept->result.map = job.result.map;
  kept->result.handles = job.result.handles;
  kept->result.other_triangles = job.result.other_triangles;
  kept->options = job.options;
  kept->options.map.initial.reset();
  kept->options.solve.watch = {};
  kept->options.solve.linear_solver = {};
  return kept;
}

// The derivatives of a map by its data.
class PythonMapSensitivity {
 public:
  // gauge: two vertices of the input.
  PythonMapSensitivity(std::shared_ptr<SolvedMap> solved,
                       const std::optional<std::array<Index, 2>>& gauge)
      : solved_(std::move(solved)) {
    MapSensitivityOptions sensitivity_options;
    sensitivity_options.gauge = gauge;
    if (gauge)
      for (Index& vertex : *sensitivity_options.gauge)
        vertex = used_vertex("gauge", mesh(), vertex);
    Run run;
    run([&] {
      sensitivity_.emplace(solved_->result, solved_->options, sensitivity_options);
      return 0;
    });
  }

  // Empty arrays stand for no change. positions: one row per vertex of the mesh.
  py::array forward(const Doubles& pins, const Doubles& handles, const Doubles& weights,
                    double handle_weight, const Doubles& positions) const {
    MapSensitivity::Change change;
    change.pins = points(pins);
    change.handles = points(handles);
    change.weights = matrix<Vec>(weights);
    change.handle_weight = handle_weight;
    change.positions = matrix<RowMatrix>(positions);
    Run run;
    return moved(run([&] {
      const Vec dx = sensitivity_->forward(change);
      return RowMatrix(Eigen::Map<const RowMatrix>(dx.data(), dx.size() / 2, 2));
    }));
  }

  // Returns derivatives by (pins, handles, weights, handle weight, positions or None).
  py::tuple adjoint(const Doubles& slope) const {
    const RowMatrix by_point = matrix<RowMatrix>(slope);
    const Vec at = Eigen::Map<const Vec>(by_point.data(), by_point.size());
    Run run;
    MapSensitivity::Derivative d = run([&] { return sensitivity_->adjoint(at); });
    py::object positions = py::none();
    if (d.positions) positions = moved(RowMatrix(*d.positions));
    return py::make_tuple(array(d.pins), array(d.handles), moved(std::move(d.weights)),
                          d.handle_weight, positions);
  }
  double error() const { return sensitivity_->error(); }
  Index motions() const { return sensitivity_->motions(); }
  py::array input_vertices() const {
    Eigen::VectorXi rows(mesh().vertex_count());
    for (Index v = 0; v < rows.size(); ++v) rows[v] = mesh().input_vertex(v);
    return moved(std::move(rows));
  }

 private:
  const SurfaceMesh& mesh() const { return solved_->result.map->mesh(); }
  static std::vector<Vector2> points(const Doubles& rows) {
    std::vector<Vector2> out;
    for (py::ssize_t k = 0; k < rows.shape(0); ++k) out.emplace_back(rows.at(k, 0), rows.at(k, 1));
    return out;
  }
  static py::array array(const std::vector<Vector2>& points) {
    RowMatrix rows(static_cast<Index>(points.size()), 2);
    for (std::size_t k = 0; k < points.size(); ++k)
      rows.row(static_cast<Index>(k)) = points[k].transpose();
    return moved(std::move(rows));
  }

  std::shared_ptr<SolvedMap> solved_;
  std::optional<MapSensitivity> sensitivity_;
};

// make_start: calls a function of the job that makes its start, or does nothing.
template <class MakeStart>
py::tuple solved(PythonJob& request, const MakeStart& make_start) {
  MapJob& job = request.job;
  const SurfaceMesh& mapped = *request.run([&] {
    job.open(request.polygons);
    job.read_seconds = job.record.seconds();
    make_start();
    return &job.mapped_mesh();
  });
  job.options = read_options(request.keywords, mapped);
  const bool has_initial = job.init == "input" && !job.start;
  request.run([&] {
    if (has_initial) job.options.map.initial = texture_map(*job.mesh);
    job.solve();
    return true;
  });
  require_result(job);
  struct Files {
    SharedMap file;
    std::string report;
  };
  const Files files = request.run([&] {
    job.prove();
    return Files{std::make_shared<MapFile>(map_file(job)), json_text(to_json(map_report(job)))};
  });
  const ParametrizationResult& result = job.result;
  return py::make_tuple(files.file, request.polygons, packed_request(proof_request(job, "map.vtu")),
                        !result.other_triangles, status_name(result.status), result.message,
                        files.report, solved_map(job));
}

py::tuple parametrize_mesh(SharedPolygons polygons, py::dict keywords, const py::object& callback) {
  PythonJob request(MapTask::Parametrize, std::move(polygons), std::move(keywords), callback);
  const bool is_seamless = keyword<bool>(request.keywords, "seamless");
  return solved(request, [&] {
    if (is_seamless) request.job.start_from_texture();
  });
}

py::tuple seamless_mesh(SharedPolygons polygons, py::dict keywords, const py::object& callback) {
  PythonJob request(MapTask::Seamless, std::move(polygons), std::move(keywords), callback);
  SeamlessOptions options;
  options.method = method_called(keyword<std::string>(request.keywords, "start"));
  options.field.curvature_weight = keyword<double>(request.keywords, "curvature_alignment");
  options.threads = keyword<int>(request.keywords, "threads");
  using Cones = std::optional<std::vector<std::pair<Index, int>>>;
  if (const auto cones = keyword<Cones>(request.keywords, "cones")) {
    options.cones.emplace();
    for (const auto& [vertex, turns] : *cones) options.cones->push_back({vertex, turns});
  }
  return solved(request, [&] { request.job.start_seamless(options, "cones"); });
}

py::tuple deform_mesh(SharedPolygons polygons, py::dict keywords, const py::object& callback) {
  PythonJob request(MapTask::Deform, std::move(polygons), std::move(keywords), callback);
  return solved(request, [&] { request.job.start_in_plane(); });
}

}  // namespace

void bind_solvers(py::module_& module) {
  const auto add = [&](const char* name, auto solver) {
    module.def(name, solver, py::arg("mesh"), py::arg("keywords"), py::arg("callback"));
  };
  py::class_<SolvedMap, std::shared_ptr<SolvedMap>>(module, "SolvedMap")
      .def_property_readonly("pin_count",
                             [](const SolvedMap& s) { return s.options.map.pins.size(); })
      .def_property_readonly("handle_count",
                             [](const SolvedMap& s) { return s.options.map.handles.size(); })
      .def_property_readonly("energy_count",
                             [](const SolvedMap& s) { return s.options.map.energy.size(); });
  py::class_<PythonMapSensitivity>(module, "MapSensitivity")
      .def(py::init<std::shared_ptr<SolvedMap>, const std::optional<std::array<Index, 2>>&>(),
           py::arg("solved"), py::arg("gauge"))
      .def("forward", &PythonMapSensitivity::forward, py::arg("pins"), py::arg("handles"),
           py::arg("weights"), py::arg("handle_weight"), py::arg("positions"))
      .def("adjoint", &PythonMapSensitivity::adjoint, py::arg("slope"))
      .def_property_readonly("error", &PythonMapSensitivity::error)
      .def_property_readonly("motions", &PythonMapSensitivity::motions)
      .def_property_readonly("input_vertices", &PythonMapSensitivity::input_vertices);
  add("parametrize", &parametrize_mesh);
  add("seamless", &seamless_mesh);
  add("deform", &deform_mesh);
}

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
