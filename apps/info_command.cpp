// majorant info IN: describes a mesh and its defects, and names the verbs that accept it.
#include <CLI/App.hpp>
#include <memory>

#include "apps/arguments/option_table.h"
#include "apps/command.h"
#include "apps/mesh_description.h"
#include "apps/run.h"
#include "majorant/io/read_mesh.h"

namespace majorant::app {
namespace {

struct InfoRequest {
  CommonOptions common;
  std::string input;
  bool plan = false;
};

int info(const InfoRequest& request) {
  const RunPlan plan{
      .command = "info", .common = request.common, .inputs = {request.input}, .stages = {}};
  return run_verb(plan, [&](Run& run) {
    const PolygonMesh polygons = run.read(request.input, [&] {
      return read_mesh(request.input, run.stop(), request.common.strictness());
    });
    Stopwatch watch;
    MeshDescription found = run.make("describing " + request.input, [&] {
      return describe_mesh(polygons, {.plan = request.plan}, run.stop());
    });
    found.report.seconds["describe"] = watch.restart();
    found.report.options = {{"plan", request.plan}, {"strict", request.common.strict}};
    Made made{.report = std::move(found.report), .is_verdict_news = true};
    if (request.common.report != kStandardOutput) made.verdict = std::move(found.text);
    return made;
  });
}

}  // namespace

void add_info(CLI::App& app, Action* run) {
  auto request = std::make_shared<InfoRequest>();
  CLI::App& verb = *app.add_subcommand(
      "info", "describe a mesh and its defects, and name the verbs that accept it");
  add_options(verb, OptionGroup::Files,
              {{"input", &request->input, surface_help(), {.required = true}}});
  add_options(verb, OptionGroup::Charts,
              {{"--plan", &request->plan, "also describe the charts and cuts of unwrap"}});
  request->common.add_to(verb);
  verb.footer("Example: majorant info bunny.obj --plan");
  verb.callback([request, run] { *run = [request] { return info(*request); }; });
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
