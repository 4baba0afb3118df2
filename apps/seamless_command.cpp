// majorant seamless IN -o OUT...: makes a seamless map with cones of a plain mesh.
#include <CLI/App.hpp>
#include <memory>
#include <utility>

#include "apps/arguments/number_check.h"
#include "apps/arguments/option_table.h"
#include "apps/arguments/suggestion.h"
#include "apps/energy_option.h"
#include "apps/map_run.h"
#include "majorant/apps/jobs/write_map.h"
#include "majorant/io/read_vertex_lists.h"

namespace majorant::app {
namespace {

struct SeamlessRequest : MapVerb {
  std::string cones, start = "automatic";
  double curvature_alignment = 0;
};

int run_job(SeamlessRequest request) {
  const StartMaker make_start = [&](MapJob& job) {
    SeamlessOptions options;
    options.method = method_called(request.start);
    options.field.curvature_weight = request.curvature_alignment;
    if (!request.cones.empty())
      options.cones = read_cones(request.cones, static_cast<Index>(job.polygons->positions.size()),
                                 job.record.start_stop());
    job.start_seamless(std::move(options), request.cones);
    request.map.init = job.init;
  };
  return run_map(MapTask::Seamless, request,
                 {.inputs = {request.cones},
                  .make_start = make_start,
                  .options = {{"cones", request.cones},
                              {"start", request.start},
                              {"curvature_alignment", request.curvature_alignment}}});
}

}  // namespace

void add_seamless(CLI::App& app, Action* run) {
  auto request = std::make_shared<SeamlessRequest>();
  CLI::App& verb = *app.add_subcommand(
      "seamless",
      "make a seamless map with cones; the mesh may be closed or bounded, of any genus");
  SeamlessRequest& r = *request;
  r.map.seamless = true;
  std::erase_if(r.outputs.extensions, [](const std::string& e) { return is_gltf("map" + e); });
  r.add_to(verb);
  add_options(
      verb, OptionGroup::Charts,
      {{"--cones",
        &r.cones,
        "JSON file of cones (default: those of a smooth cross field)",
        {.type = "FILE"}},
       {"--start",
        &r.start,
        "method of the initial map (automatic)",
        {.check = one_of({"automatic", "field", "scaled-field", "conformal"})}},
       {"--curvature-alignment",
        &r.curvature_alignment,
        "weight with which the cross field follows principal directions; 5 to 50 are useful (0)",
        {.check = non_negative_number(kLargestFactor), .excludes = {"--cones"}}}});
  verb.footer(energy_help() +
              "Example: majorant seamless bunny.obj -o bunny.vtu -o bunny.svg --degree 3");
  verb.callback([request, run] { *run = [request] { return run_job(*request); }; });
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
