// majorant parametrize IN -o OUT...: the main job.
#include <CLI/App.hpp>
#include <chrono>
#include <limits>
#include <memory>

#include "apps/command.h"
#include "apps/energy_option.h"
#include "apps/map_request.h"
#include "apps/progress.h"
#include "apps/result_files.h"
#include "majorant/framework/curvature_name.h"
#include "majorant/parametrization/parametrize.h"

namespace majorant::app {
namespace {

// Everything the user can say, as said.
struct Request {
  CommonOptions common;
  MapRequest map;
  OutputRequest outputs;
  std::string elevation = "incremental";
  int max_iterations = 1000;
  double tolerance = 1e-6, time_limit = std::numeric_limits<double>::infinity();
};

MapInput read(const Request& request) {
  MapInput in = read_input(request.map);
  if (request.elevation == "direct") in.options.elevation = Elevation::Direct;
  in.options.tolerance = request.tolerance;
  return in;
}

int run_job(Request request) {
  const auto start = std::chrono::steady_clock::now();
  request.outputs.require_usable(request.common, request.map);
  if (!(request.time_limit >= 0))
    throw Error(ErrorKind::Usage, "--time-limit is not a number of seconds");
  request.common.apply();
  const MapInput in = read(request);
  const std::chrono::duration<double> read_time = std::chrono::steady_clock::now() - start;
  RunRecord record(request.time_limit, request.max_iterations, interruption_flag(),
                   make_progress(request.common));
  const ParametrizationResult result = in.start ? parametrize(in.start->map, in.options, record)
                                                : parametrize(in.mesh, in.options, record);
  finish_progress(request.common);
  const Json options{{"elevation", request.elevation},
                     {"tolerance", request.tolerance},
                     {"max_iterations", request.max_iterations}};
  return write_result({"parametrize", request.common, request.outputs, request.map, in, result,
                       record, options, start, read_time.count()});
}

}  // namespace

void add_parametrize(CLI::App& app, Action* run) {
  auto request = std::make_shared<Request>();
  CLI::App& verb = *app.add_subcommand(
      "parametrize", "map a surface mesh onto the plane, injectively and with low distortion");
  Request& r = *request;
  r.map.add_to(verb);
  r.outputs.add_to(verb);
  verb.add_flag("--seamless", r.map.seamless,
                "hold the seams of the input's texture coordinates, up to rotations by 90 degrees");
  std::vector<std::string> curvatures;
  for (const Curvature c : kCurvatures) curvatures.emplace_back(name(c));
  verb.add_option("--curvature", r.map.curvature, "second-order model (projected)")
      ->check(CLI::IsMember(curvatures));
  verb.add_option("--elevation", r.elevation, "how the degree is reached")
      ->check(CLI::IsMember({"incremental", "direct"}));
  verb.add_option("--tolerance", r.tolerance, "relative energy decrease to stop at (1e-6)")
      ->check(CLI::PositiveNumber);
  verb.add_option("--max-iterations", r.max_iterations, "(1000)")->check(CLI::NonNegativeNumber);
  verb.add_option("--time-limit", r.time_limit, "seconds; the best valid map is written")
      ->check(CLI::NonNegativeNumber);
  r.common.add_to(verb);
  verb.footer(energy_help() +
              "Example: majorant parametrize bunny.obj -o bunny.vtu -o bunny.svg --degree 3 "
              "--report bunny.json");
  verb.callback([request, run] { *run = [request] { return run_job(*request); }; });
}

}  // namespace majorant::app
