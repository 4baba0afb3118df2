// majorant info IN: what a mesh is, and what a run would do about it.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <cstdio>
#include <memory>

#include "apps/command.h"
#include "apps/outputs.h"
#include "apps/report.h"
#include "majorant/io/read_mesh.h"

namespace majorant::app {
namespace {

struct Request {
  CommonOptions common;
  std::string input;
};

int info(const Request& request) {
  if (!request.common.report.empty()) require_writable({request.common.report}, {".json"});
  const PolygonMesh polygons = read_mesh(request.input);
  Json report{{"schema_version", 1}, {"version", MAJORANT_VERSION}, {"command", "info"}};
  fmt::print("file: {}\nvertices: {}\npolygons: {}\ntexture coordinates: {}\n", polygons.file,
             polygons.positions.size(), polygons.polygons.size(), polygons.texcoords.size());
  std::string verdict = "parametrize can run";
  try {
    const SurfaceMesh mesh = SurfaceMesh::from_polygons(polygons);
    const Topology& t = mesh.topology();
    fmt::print(
        "triangles: {}\ncomponents: {}\nboundary loops: {}\nEuler characteristic: {}\n"
        "area: {:.10g}\n",
        t.faces, t.components, t.boundary_loops, t.euler_characteristic(), mesh.area());
    report["input"] = input_section(polygons, mesh);
    for (const auto& repair : report["input"]["repairs"])
      fmt::print("note: {}\n", repair.get<std::string>());
    mesh.require_disk();
  } catch (const Error& e) {
    verdict = fmt::format("parametrize would refuse: {}", e.what());
  }
  fmt::print("verdict: {}\n", verdict);
  report["message"] = verdict;
  if (!request.common.report.empty()) write_json(request.common.report, report);
  return kSuccess;
}

}  // namespace

void add_info(CLI::App& app, Action* run) {
  auto request = std::make_shared<Request>();
  CLI::App& verb = *app.add_subcommand("info", "describe a mesh and its defects");
  verb.add_option("input", request->input, "mesh: .obj .off .ply .stl .vtu")->required();
  request->common.add_to(verb);
  verb.footer("Example: majorant info bunny.obj");
  verb.callback([request, run] { *run = [request] { return info(*request); }; });
}

}  // namespace majorant::app
