// majorant deform IN -o OUT...: a planar mesh moved by point handles.
#include <CLI/App.hpp>
#include <chrono>
#include <memory>

#include "apps/command.h"
#include "apps/energy_option.h"
#include "apps/map_request.h"
#include "apps/progress.h"
#include "apps/result_files.h"
#include "apps/solve_request.h"
#include "majorant/parametrization/deform.h"

namespace majorant::app {
namespace {

struct Request {
  CommonOptions common;
  MapRequest map;
  OutputRequest outputs;
  SolveRequest solve;
};

int run_job(Request request) {
  const auto start = std::chrono::steady_clock::now();
  if (request.map.handles.empty() && request.map.pins.empty())
    throw Error(ErrorKind::Usage,
                "nothing to do: give --handles FILE (soft) or --pins FILE (hard)");
  request.outputs.require_usable(request.common, request.map);
  request.solve.require_usable(request.outputs, request.map);
  RunRecord record = request.solve.make_record(request.common);
  request.common.apply();
  request.map.init = "planar";
  MapInput in = read_input(request.map, [](const PolygonMesh&, const SurfaceMesh& mesh) {
    return SeamlessStart{planar_map(std::make_shared<const SurfaceMesh>(mesh))};
  });
  request.solve.apply(in.options);
  const std::chrono::duration<double> read_time = std::chrono::steady_clock::now() - start;
  ParametrizationResult result = deform(in.start->map, in.options, record);
  finish_progress(request.common);
  request.solve.finish(in.options, result);
  return write_result({"deform", request.common, request.outputs, request.map, in, result, record,
                       request.solve.to_json(), start, read_time.count()});
}

}  // namespace

void add_deform(CLI::App& app, Action* run) {
  auto request = std::make_shared<Request>();
  CLI::App& verb = *app.add_subcommand("deform", "move a planar mesh by point handles");
  Request& r = *request;
  r.map.add_to(verb);
  r.outputs.add_to(verb);
  r.solve.add_to(verb, r.map.curvature);
  r.common.add_to(verb);
  verb.footer(energy_help() +
              "Example: majorant deform bar.obj --handles bar.json --bijective -o bent.vtu -o "
              "bent.svg");
  verb.callback([request, run] { *run = [request] { return run_job(*request); }; });
}

}  // namespace majorant::app
