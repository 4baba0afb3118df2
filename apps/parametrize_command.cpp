// majorant parametrize IN -o OUT...: the main job.
#include <CLI/App.hpp>
#include <memory>

#include "apps/energy_option.h"
#include "apps/map_run.h"
#include "apps/unless_stopped.h"
#include "majorant/parametrization/drive/parametrize.h"

namespace majorant::app {
namespace {

int run_job(MapVerb request) {
  MapRun run("parametrize", request);
  const MapInput& in = run.read();
  return run.finish(unless_stopped("making the start of " + request.map.input, [&] {
    return in.start ? parametrize(in.start->map, in.options, run.record())
                    : parametrize(in.mesh, in.options, run.record());
  }));
}

}  // namespace

void add_parametrize(CLI::App& app, Action* run) {
  auto request = std::make_shared<MapVerb>();
  CLI::App& verb = *app.add_subcommand(
      "parametrize", "map a surface mesh onto the plane, injectively and with low distortion");
  request->add_to(verb);
  request->map.add_start_to(verb);
  verb.add_flag("--seamless", request->map.seamless,
                "hold the seams of the input's texture coordinates, up to rotations by 90 degrees");
  verb.footer(energy_help() +
              "Example: majorant parametrize bunny.obj -o bunny.vtu -o bunny.svg --degree 3 "
              "--report bunny.json");
  verb.callback([request, run] { *run = [request] { return run_job(*request); }; });
}

}  // namespace majorant::app
