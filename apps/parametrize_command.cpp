// majorant parametrize IN -o OUT...: maps a surface onto the plane.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <memory>

#include "apps/arguments/option_table.h"
#include "apps/energy_option.h"
#include "apps/map_run.h"
#include "apps/seam_request.h"
#include "majorant/framework/error.h"

namespace majorant::app {
namespace {

struct ParametrizeRequest : MapVerb {
  SeamRequest seams;
};

// Cuts the surface; cuts avoid vertices with pins or handles.
void cut_open(const ParametrizeRequest& request, MapJob& job) {
  CutOptions options = request.seams.options(*job.polygons, job.record.start_stop());
  const MapOptions map =
      read_options(request.map, *job.polygons, *job.mesh, job.record.start_stop()).map;
  for (const auto* points : {&map.pins, &map.handles})
    for (const Pin& p : *points) options.whole.push_back(p.vertex);
  job.start_cut(options, [&](Index pieces) {
    return fmt::format(
        "{}: --seams {} leaves {} pieces, parametrize maps one; `majorant "
        "unwrap {} --seams {} -o OUT` maps them all",
        job.mesh->file(), request.seams.seams, pieces, job.mesh->file(), request.seams.seams);
  });
}

int run_job(ParametrizeRequest request) {
  if (request.map.seamless && request.map.init != "auto" && request.map.init != "input")
    throw Error(ErrorKind::Usage,
                fmt::format("--seamless starts from the texture coordinates; leave out --init {}",
                            request.map.init));
  request.map.strictness = request.seams.needed_of_file();
  if (request.seams.seams.empty()) return run_map(MapTask::Parametrize, request, {});
  return run_map(MapTask::Parametrize, request,
                 {.inputs = {request.seams.file()},
                  .make_start = [&](MapJob& job) { cut_open(request, job); },
                  .options = request.seams.to_json()});
}

}  // namespace

void add_parametrize(CLI::App& app, Action* run) {
  auto request = std::make_shared<ParametrizeRequest>();
  CLI::App& verb = *app.add_subcommand(
      "parametrize", "map a surface mesh onto the plane, injectively and with low distortion");
  request->add_to(verb);
  request->map.add_start_to(verb);
  request->solve.add_effort_to(verb);
  add_options(
      verb, OptionGroup::Charts,
      {{"--seamless", &request->map.seamless,
        "hold the seams of the input's texture coordinates, up to rotations by 90 degrees"}});
  request->seams.add_to(verb);
  verb.get_option("--seams")->excludes("--seamless")->excludes("--init");
  verb.get_option("--max-stretch")->needs("--seams");
  verb.footer(energy_help() +
              "Example: majorant parametrize bunny.obj -o bunny.vtu -o bunny.svg --degree 3 "
              "--report bunny.json");
  verb.callback([request, run] { *run = [request] { return run_job(*request); }; });
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
