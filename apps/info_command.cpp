// majorant info IN: what a mesh is, and what a run would do about it.
#include <CLI/App.hpp>
#include <memory>

#include "apps/command.h"
#include "apps/outputs.h"
#include "apps/report.h"
#include "apps/streams.h"
#include "majorant/io/read_mesh.h"
#include "majorant/parametrization/starts/texture_seams.h"

namespace majorant::app {
namespace {

struct Request {
  CommonOptions common;
  std::string input;
};

// Says whether the texture coordinates, if there are any, are a seamless map; true if they have
// seams that --seamless would hold.
bool describe_texture(const SurfaceMesh& mesh, Json& report) {
  if (mesh.corner_texcoords().rows() == 0) return false;
  try {
    const BezierMap map = seamless_from_texture(mesh).map;
    const Seams& seams = map.seams();
    const Json cones = cones_section(map);
    print_data("texture: seamless, {} cones, {} chains of {} seam edges\n", cones.size(),
               seams.chain_count(), seams.edges().size());
    report["texture"] = {{"seamless", true},
                         {"cones", cones},
                         {"chains", seams.chain_count()},
                         {"seam_edges", seams.edges().size()}};
    return !seams.trivial();
  } catch (const Error& e) {
    print_data("texture: not seamless: {}\n", e.what());
    report["texture"] = {{"seamless", false}, {"message", e.what()}};
    return false;
  }
}

int info(const Request& request) {
  require_writable(request.common, {}, {request.input});
  const PolygonMesh polygons = read_mesh(request.input);
  Json report{{"schema_version", 1}, {"version", MAJORANT_VERSION}, {"command", "info"}};
  print_data("file: {}\nvertices: {}\npolygons: {}\ntexture coordinates: {}\n", polygons.file,
             polygons.positions.size(), polygons.polygons.size(), polygons.texcoords.size());
  std::string verdict = "parametrize can run";
  try {
    const SurfaceMesh mesh = SurfaceMesh::from_polygons(polygons);
    const Topology& t = mesh.topology();
    print_data(
        "triangles: {}\ncomponents: {}\nboundary loops: {}\nEuler characteristic: {}\n"
        "area: {:.10g}\n",
        t.faces, t.components, t.boundary_loops, t.euler_characteristic(), mesh.area());
    report["input"] = input_section(polygons, mesh);
    for (const auto& repair : report["input"]["repairs"])
      print_data("note: {}\n", repair.get<std::string>());
    const bool has_seams = describe_texture(mesh, report);
    const bool is_disk = t.boundary_loops == 1 && t.euler_characteristic() == 1;
    if (has_seams)
      verdict =
          is_disk ? "parametrize can run, with --seamless too" : "parametrize --seamless can run";
    else
      mesh.require_planar();
  } catch (const Error& e) {
    verdict = fmt::format("parametrize would refuse: {}", e.what());
  }
  print_data("verdict: {}\n", verdict);
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
