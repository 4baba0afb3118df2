#include "solve.h"

#include <pybind11/stl.h>

#include <string>

#include "arrays.h"
#include "majorant/framework/error.h"
#include "majorant/parametrization/drive/deform.h"
#include "majorant/parametrization/starts/make_seamless.h"
#include "majorant/parametrization/starts/texture_seams.h"
#include "majorant/results/internal/finished_map.h"
#include "majorant/results/internal/input_points.h"
#include "majorant/results/internal/solver_ladder.h"
#include "map_file.h"
#include "mesh.h"
#include "options.h"
#include "run.h"
#include "unwrap.h"

namespace majorant::python {
namespace {

struct Job {
  Job(std::string verb_, SharedPolygons polygons_, py::dict wishes_, const py::object& callback)
      : verb(std::move(verb_)),
        polygons(std::move(polygons_)),
        wishes(std::move(wishes_)),
        run(wish<double>(wishes, "time_limit"), wish<int>(wishes, "max_iterations"), callback) {}

  std::string verb;
  SharedPolygons polygons;
  py::dict wishes;
  Run run;
  std::shared_ptr<const SurfaceMesh> mesh;
  std::optional<Start> start;
  ParametrizationOptions options;
  double read_seconds = 0;
};

// Throws Error where there is no map.
void require_result(const ParametrizationResult& result) {
  if (has_result(result)) return;
  const bool is_infeasible = result.status == Status::Infeasible;
  throw Error(is_infeasible ? ErrorKind::Infeasible : ErrorKind::Invalid,
              "no valid map: " + std::string(status_name(result.status)) +
                  (result.message.empty() ? "" : ", " + result.message));
}

py::tuple finish(Job& job, const ParametrizationResult& result) {
  require_result(result);
  FinishedMap finished{job.verb,
                       *job.polygons,
                       *job.mesh,
                       job.options.map,
                       result,
                       job.run.record(),
                       wish<std::string>(job.wishes, "energy_text"),
                       wish<std::string>(job.wishes, "init")};
  finished.options = Json::parse(wish<std::string>(job.wishes, "as_json"));
  finished.read_seconds = job.read_seconds;
  finished.linear_solver = linear_solver_section("direct", OwnSolver::Used, {});
  if (job.start) {
    finished.start = &*job.start;
    finished.init = job.verb == "seamless" ? method_name(job.start->method)
                    : job.verb == "deform" ? std::string_view("planar")
                                           : start_name(StartMethod::Given);
  }
  struct Files {
    SharedMap file;
    std::string report;
  };
  const Files files = job.run([&] {
    finished.boundary = prove_boundary(result, job.run.record());
    return Files{std::make_shared<MapFile>(map_file(finished)), json_text(map_report(finished))};
  });
  return py::make_tuple(files.file, job.polygons, promise_from(promise(finished, "map.vtu")),
                        !result.other_triangles, status_name(result.status), result.message,
                        files.report);
}

// start: gives the map to start from, or nothing.
template <class MakeStart, class Solve>
py::tuple solved(Job& job, const MakeStart& make_start, const Solve& solve) {
  job.run([&] {
    const StopCheck& stop = job.run.record().start_stop();
    job.mesh = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(*job.polygons, stop));
    job.read_seconds = job.run.record().seconds();
    make_start();
    if (!job.start) job.mesh->require_planar();
    return true;
  });
  job.options = read_options(job.wishes, job.start ? job.start->map.mesh() : *job.mesh);
  const ParametrizationResult result = job.run(solve);
  return finish(job, result);
}

py::tuple parametrize_mesh(SharedPolygons polygons, py::dict wishes, const py::object& callback) {
  Job job("parametrize", std::move(polygons), std::move(wishes), callback);
  const bool is_seamless = wish<bool>(job.wishes, "seamless");
  const bool has_initial = wish<std::string>(job.wishes, "init") == "input" && !is_seamless;
  const auto make_start = [&] {
    if (is_seamless) job.start = seamless_from_texture(*job.mesh);
  };
  return solved(job, make_start, [&] {
    if (has_initial) job.options.map.initial = texture_map(*job.mesh);
    return job.start ? parametrize(job.start->map, job.options, job.run.record())
                     : parametrize(job.mesh, job.options, job.run.record());
  });
}

py::tuple seamless_mesh(SharedPolygons polygons, py::dict wishes, const py::object& callback) {
  Job job("seamless", std::move(polygons), std::move(wishes), callback);
  SeamlessOptions options;
  options.method = SeamlessMethod::Automatic;
  for (const SeamlessMethod m :
       {SeamlessMethod::Field, SeamlessMethod::ScaledField, SeamlessMethod::Conformal})
    if (method_name(m) == wish<std::string>(job.wishes, "start")) options.method = m;
  options.field.curvature_weight = wish<double>(job.wishes, "curvature_alignment");
  options.threads = wish<int>(job.wishes, "threads");
  using Cones = std::optional<std::vector<std::pair<Index, int>>>;
  const auto cones = wish<Cones>(job.wishes, "cones");
  const auto make_start = [&] {
    if (cones) {
      options.cones.emplace();
      for (const auto& [vertex, turns] : *cones)
        options.cones->push_back({used_vertex("cones", *job.mesh, vertex), turns});
    }
    job.start = make_seamless(*job.mesh, options, job.run.record());
  };
  return solved(job, make_start,
                [&] { return parametrize(job.start->map, job.options, job.run.record()); });
}

py::tuple deform_mesh(SharedPolygons polygons, py::dict wishes, const py::object& callback) {
  Job job("deform", std::move(polygons), std::move(wishes), callback);
  const auto make_start = [&] { job.start = Start{planar_map(job.mesh)}; };
  return solved(job, make_start,
                [&] { return deform(job.start->map, job.options, job.run.record()); });
}

}  // namespace

void bind_solvers(py::module_& module) {
  const auto add = [&](const char* name, auto solver) {
    module.def(name, solver, py::arg("mesh"), py::arg("wishes"), py::arg("callback"));
  };
  add("parametrize", &parametrize_mesh);
  add("seamless", &seamless_mesh);
  add("deform", &deform_mesh);
  add("unwrap", &unwrap_mesh);
}

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
