// majorant parametrize IN -o OUT...: the main job.
#include <CLI/App.hpp>
#include <chrono>
#include <memory>

#include "apps/command.h"
#include "apps/energy_option.h"
#include "apps/map_request.h"
#include "apps/progress.h"
#include "apps/result_files.h"
#include "apps/solve_request.h"
#include "majorant/parametrization/parametrize.h"

namespace majorant::app {
namespace {

// Everything the user can say, as said.
struct Request {
  CommonOptions common;
  MapRequest map;
  OutputRequest outputs;
  SolveRequest solve;
};

int run_job(Request request) {
  const auto start = std::chrono::steady_clock::now();
  request.outputs.require_usable(request.common, request.map);
  request.solve.require_usable(request.outputs, request.map);
  RunRecord record = request.solve.make_record(request.common);
  request.common.apply();
  request.map.holes = request.solve.bijective;
  MapInput in = read_input(request.map);
  request.solve.apply(in.options);
  const std::chrono::duration<double> read_time = std::chrono::steady_clock::now() - start;
  ParametrizationResult result = in.start ? parametrize(in.start->map, in.options, record)
                                          : parametrize(in.mesh, in.options, record);
  finish_progress(request.common);
  request.solve.finish(in.options, result);
  return write_result({"parametrize", request.common, request.outputs, request.map, in, result,
                       record, request.solve.to_json(), start, read_time.count()});
}

}  // namespace

void add_parametrize(CLI::App& app, Action* run) {
  auto request = std::make_shared<Request>();
  CLI::App& verb = *app.add_subcommand(
      "parametrize", "map a surface mesh onto the plane, injectively and with low distortion");
  Request& r = *request;
  r.map.add_to(verb);
  r.map.add_start_to(verb);
  r.outputs.add_to(verb);
  verb.add_flag("--seamless", r.map.seamless,
                "hold the seams of the input's texture coordinates, up to rotations by 90 degrees");
  r.solve.add_to(verb, r.map.curvature);
  r.common.add_to(verb);
  verb.footer(energy_help() +
              "Example: majorant parametrize bunny.obj -o bunny.vtu -o bunny.svg --degree 3 "
              "--report bunny.json");
  verb.callback([request, run] { *run = [request] { return run_job(*request); }; });
}

}  // namespace majorant::app
