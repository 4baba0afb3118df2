// majorant deform IN -o OUT...: deforms a planar mesh by point handles.
#include <CLI/App.hpp>
#include <memory>

#include "apps/energy_option.h"
#include "apps/map_run.h"
#include "majorant/framework/error.h"

namespace majorant::app {
namespace {

int run_job(MapVerb request) {
  if (request.map.handles.empty() && request.map.pins.empty())
    throw Error(ErrorKind::Usage,
                "nothing to do: give --handles FILE (soft) or --pins FILE (hard)");
  request.map.init = "planar";
  return run_map(MapTask::Deform, request,
                 {.make_start = [](MapJob& job) { job.start_in_plane(); }});
}

}  // namespace

void add_deform(CLI::App& app, Action* run) {
  auto request = std::make_shared<MapVerb>();
  CLI::App& verb = *app.add_subcommand("deform", "deform a planar mesh by point handles");
  request->add_to(verb);
  verb.footer(energy_help() +
              "Example: majorant deform bar.obj --handles bar.json --bijective -o bent.vtu -o "
              "bent.svg");
  verb.callback([request, run] { *run = [request] { return run_job(*request); }; });
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
