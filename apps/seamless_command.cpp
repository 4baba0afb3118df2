// majorant seamless IN -o OUT...: from a plain mesh to a seamless map with cones.
#include <CLI/App.hpp>
#include <chrono>
#include <memory>

#include "apps/command.h"
#include "apps/energy_option.h"
#include "apps/map_request.h"
#include "apps/progress.h"
#include "apps/result_files.h"
#include "apps/solve_request.h"
#include "majorant/io/read_vertex_lists.h"
#include "majorant/parametrization/parametrize.h"
#include "majorant/parametrization/seamless_map.h"

namespace majorant::app {
namespace {

struct Request {
  CommonOptions common;
  MapRequest map;
  OutputRequest outputs;
  SolveRequest solve;
  std::string cones, start = "automatic";
  double curvature_alignment = 0;
};

SeamlessMethod find_method(const std::string& wanted) {
  for (const SeamlessMethod m :
       {SeamlessMethod::Field, SeamlessMethod::ScaledField, SeamlessMethod::Conformal})
    if (name(m) == wanted) return m;
  return SeamlessMethod::Automatic;
}

// Cones of the file, by vertex of the mesh.
std::vector<Cone> read_cones_of(const std::string& path, const PolygonMesh& polygons,
                                const SurfaceMesh& mesh) {
  std::vector<Cone> cones = read_cones(path, static_cast<Index>(polygons.positions.size()));
  for (Cone& cone : cones) {
    const Index vertex = mesh.find_input_vertex(cone.vertex);
    if (vertex < 0)
      throw Error(ErrorKind::Unsupported, path + ": vertex " + std::to_string(cone.vertex) +
                                              " belongs to no face; take another");
    cone.vertex = vertex;
  }
  return cones;
}

int run_job(Request request) {
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  request.outputs.require_usable(request.common, request.map);
  request.solve.require_usable(request.outputs, request.map);
  RunRecord record = request.solve.make_record(request.common);
  request.common.apply();
  double read_seconds = 0, initialize_seconds = 0;
  MapInput in = read_input(request.map, [&](const PolygonMesh& polygons, const SurfaceMesh& mesh) {
    SeamlessOptions options;
    options.method = find_method(request.start);
    options.field.curvature_weight = request.curvature_alignment;
    if (!request.cones.empty()) options.cones = read_cones_of(request.cones, polygons, mesh);
    read_seconds = seconds();
    SeamlessMap made = make_seamless(mesh, options, record);
    initialize_seconds = seconds() - read_seconds;
    request.map.init = name(made.method);
    return SeamlessStart{std::move(made.map), 0, 0, made.inverted, made.untangling_steps};
  });
  request.solve.apply(in.options);
  ParametrizationResult result = parametrize(in.start->map, in.options, record);
  result.initialize_seconds = initialize_seconds;
  finish_progress(request.common);
  request.solve.finish(in.options, result);
  Json options = request.solve.to_json();
  options["cones"] = request.cones;
  options["start"] = request.start;
  options["curvature_alignment"] = request.curvature_alignment;
  return write_result({"seamless", request.common, request.outputs, request.map, in, result, record,
                       options, start, read_seconds});
}

}  // namespace

void add_seamless(CLI::App& app, Action* run) {
  auto request = std::make_shared<Request>();
  CLI::App& verb = *app.add_subcommand(
      "seamless",
      "make a seamless map with cones of a plain mesh, closed or bounded, of any genus");
  Request& r = *request;
  r.map.seamless = true;
  r.map.add_to(verb);
  r.outputs.add_to(verb);
  verb.add_option("--cones", r.cones, "the cones, JSON (default: those of a smooth cross field)")
      ->type_name("FILE");
  verb.add_option("--start", r.start, "what the map is made from (automatic)")
      ->check(CLI::IsMember({"automatic", "field", "scaled-field", "conformal"}));
  verb.add_option("--curvature-alignment", r.curvature_alignment,
                  "pull of principal directions on the cross field, 5 to 50 are useful (0)")
      ->check(CLI::NonNegativeNumber);
  r.solve.add_to(verb, r.map.curvature);
  r.common.add_to(verb);
  verb.footer(energy_help() +
              "Example: majorant seamless bunny.obj -o bunny.vtu -o bunny.svg --degree 3");
  verb.callback([request, run] { *run = [request] { return run_job(*request); }; });
}

}  // namespace majorant::app
