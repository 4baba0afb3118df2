// The solvers of maps.
#include <pybind11/stl.h>

#include <string>

#include "arrays.h"
#include "majorant/apps/jobs/map_job.h"
#include "majorant/apps/jobs/solver_ladder.h"
#include "majorant/framework/error.h"
#include "majorant/parametrization/initialization/start.h"
#include "map_file.h"
#include "mesh.h"
#include "module.h"
#include "options.h"
#include "run.h"

namespace majorant::python {
namespace {

// A MapJob as Python runs it.
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

// Throws Error where there is no map.
void require_result(const MapJob& job) {
  if (job.has_result()) return;
  const ParametrizationResult& result = job.result;
  const bool is_infeasible = result.status == Status::Infeasible;
  throw Error(is_infeasible ? ErrorKind::Infeasible : ErrorKind::Invalid,
              "no valid map: " + std::string(status_name(result.status)) +
                  (result.message.empty() ? "" : ", " + result.message));
}

// make_start: calls one of the job's own, or none.
template <class MakeStart>
py::tuple solved(PythonJob& asked, const MakeStart& make_start) {
  MapJob& job = asked.job;
  const SurfaceMesh& mapped = *asked.run([&] {
    job.open(asked.polygons);
    job.read_seconds = job.record.seconds();
    make_start();
    return &job.mapped_mesh();
  });
  job.options = read_options(asked.keywords, mapped);
  const bool has_initial = job.init == "input" && !job.start;
  asked.run([&] {
    if (has_initial) job.options.map.initial = texture_map(*job.mesh);
    job.solve();
    return true;
  });
  require_result(job);
  struct Files {
    SharedMap file;
    std::string report;
  };
  const Files files = asked.run([&] {
    job.prove();
    return Files{std::make_shared<MapFile>(map_file(job)), json_text(to_json(map_report(job)))};
  });
  const ParametrizationResult& result = job.result;
  return py::make_tuple(files.file, asked.polygons, promise_from(promise(job, "map.vtu")),
                        !result.other_triangles, status_name(result.status), result.message,
                        files.report);
}

py::tuple parametrize_mesh(SharedPolygons polygons, py::dict keywords, const py::object& callback) {
  PythonJob asked(MapTask::Parametrize, std::move(polygons), std::move(keywords), callback);
  const bool is_seamless = keyword<bool>(asked.keywords, "seamless");
  return solved(asked, [&] {
    if (is_seamless) asked.job.start_from_texture();
  });
}

py::tuple seamless_mesh(SharedPolygons polygons, py::dict keywords, const py::object& callback) {
  PythonJob asked(MapTask::Seamless, std::move(polygons), std::move(keywords), callback);
  SeamlessOptions options;
  options.method = method_called(keyword<std::string>(asked.keywords, "start"));
  options.field.curvature_weight = keyword<double>(asked.keywords, "curvature_alignment");
  options.threads = keyword<int>(asked.keywords, "threads");
  using Cones = std::optional<std::vector<std::pair<Index, int>>>;
  if (const auto cones = keyword<Cones>(asked.keywords, "cones")) {
    options.cones.emplace();
    for (const auto& [vertex, turns] : *cones) options.cones->push_back({vertex, turns});
  }
  return solved(asked, [&] { asked.job.start_seamless(options, "cones"); });
}

py::tuple deform_mesh(SharedPolygons polygons, py::dict keywords, const py::object& callback) {
  PythonJob asked(MapTask::Deform, std::move(polygons), std::move(keywords), callback);
  return solved(asked, [&] { asked.job.start_in_plane(); });
}

}  // namespace

void bind_solvers(py::module_& module) {
  const auto add = [&](const char* name, auto solver) {
    module.def(name, solver, py::arg("mesh"), py::arg("keywords"), py::arg("callback"));
  };
  add("parametrize", &parametrize_mesh);
  add("seamless", &seamless_mesh);
  add("deform", &deform_mesh);
}

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
