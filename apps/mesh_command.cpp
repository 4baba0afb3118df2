// majorant mesh check IN: proves which elements of a curved mesh are valid, and finds sides on
// which neighbours disagree. See docs/volumes.md; `mesh optimize` has a file of its own.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <memory>

#include "apps/arguments/help_text.h"
#include "apps/arguments/number_check.h"
#include "apps/arguments/option_table.h"
#include "apps/command.h"
#include "apps/mesh_verbs.h"
#include "apps/outputs.h"
#include "apps/page_content.h"
#include "apps/run.h"
#include "apps/streams.h"
#include "apps/within_memory.h"
#include "majorant/apps/jobs/volume_pictures.h"
#include "majorant/apps/jobs/volume_report.h"
#include "majorant/io/volume_files.h"
#include "majorant/volumes/check_volume_mesh.h"

namespace majorant::app {
namespace {

struct MeshCheckRequest {
  CommonOptions common;
  std::string input;
  std::vector<std::string> outputs;
  int listed = 10;  // largest number of elements in the verdict and the report
  double time_limit = std::numeric_limits<double>::infinity();
};

// Returns "part.msh: valid: ...", and a line for each of the worst elements of an invalid mesh.
std::string verdict_of(const MeshCheckRequest& request, const VolumeMesh& mesh,
                       const VolumeCheck& check) {
  const Extremes all = extremes_of(check);
  const std::string faults = faults_in_words(mesh, check);
  std::string text = one_line(fmt::format(
      "{}: {}: {}{}{}; {}; min det J in [{:.4g}, {:.4g}], scaled Jacobian at least {:.4g}, mean "
      "{:.4g}\n",
      request.input, status_of(check), faults, faults.empty() ? "det J > 0 all over" : "",
      periodic_in_words(check),
      elements_in_words(mesh) + (check.is_surface ? ", against their straight normals" : ""),
      all.low, all.high, check.least_scaled_jacobian(), check.mean_scaled_jacobian()));
  return check.is_valid() ? text : text + bad_elements_in_words(mesh, check, request.listed);
}

// Writes the elements that are not proven valid as a .vtu; or the listed elements as a page, or
// marked in a picture of the mesh.
void write_elements(const std::string& path, const MeshCheckRequest& request,
                    const VolumeMesh& mesh, const VolumeCheck& check, const StopCheck& stop) {
  if (is_shown_as(Format::Picture::Image, path)) {
    try {
      return write_space_png(path, picture_of_elements(mesh, check, request.listed, stop), stop);
    } catch (const Stopped& stopped) {  // a stop leaves out drawings
      throw Error(ErrorKind::Usage, fmt::format("{} while drawing {}", stopped.what(), path));
    }
  }
  if (!is_page(path)) {
    std::vector<const CheckedCell*> bad;
    for (const CheckedCell& cell : check.cells)
      if (cell.range.positive != ProofStatus::Proven) bad.push_back(&cell);
    return write_cells_vtu(path, mesh, bad);
  }
  MapPage page = page_of_elements(mesh, check.worst(to_size(request.listed)));
  page.title = page_title(request.input);
  page.facts = page_facts(volume_check_report(mesh, check, request.listed), {request.input});
  write_page(path, page);
}

// A mesh and its findings, from which all files are written.
struct CheckedMesh {
  VolumeMesh mesh;
  VolumeCheck check;
};

Made verdict(const MeshCheckRequest& request, CheckedMesh& c, Run& run) {
  c.mesh = run.read(request.input, [&] { return read_volume_mesh(request.input, run.stop()); });
  run.record().begin(Activity::Proving);
  const double before = run.seconds();
  c.check = run.make("checking " + request.input, [&] {
    return within_memory(
        request.input, [&] { return check_volume_mesh(c.mesh, run.record().telling(run.stop())); });
  });
  Made made{.report = volume_check_report(c.mesh, c.check, request.listed)};
  made.report.options = {{"list", request.listed}, {"strict", request.common.strict}};
  made.report.seconds["check"] = run.seconds() - before;
  made.verdict = verdict_of(request, c.mesh, c.check);
  made.is_verdict_news = !c.check.is_valid();
  for (const std::string& path : request.outputs)
    made.files.push_back(
        {path, [&, path] { write_elements(path, request, c.mesh, c.check, run.stop()); }});
  return made;
}

int mesh_check(const MeshCheckRequest& request) {
  if (request.listed == 0 && has_page(request.outputs))
    throw Error(ErrorKind::Usage,
                "--list 0: a page shows the elements that are listed, one at least");
  const RunPlan plan{.command = "mesh check",
                     .common = request.common,
                     .inputs = {request.input},
                     .outputs = {{request.outputs, {".vtu", ".html", ".png"}}},
                     .stages = {Activity::Reading, Activity::Proving},
                     .time_limit = request.time_limit};
  CheckedMesh checked;
  return run_verb(plan, [&](Run& run) { return verdict(request, checked, run); });
}

}  // namespace

void add_mesh_check(CLI::App& mesh, Action* run) {
  auto request = std::make_shared<MeshCheckRequest>();
  CLI::App& verb = *mesh.add_subcommand("check", "prove which elements of a mesh are valid");
  constexpr double kAnySeconds = std::numeric_limits<double>::infinity();
  add_options(verb, OptionGroup::Files,
              {{"input",
                &request->input,
                "mesh of volumes or surfaces: " + cells_help(),
                {.required = true}},
               {"-o,--output",
                &request->outputs,
                "elements that are not proven valid: .vtu; the listed elements as a page: .html, "
                "or marked in the mesh, cut open: .png; repeatable",
                {.type = "FILE"}}});
  add_options(verb, OptionGroup::Map,
              {{"--list",
                &request->listed,
                "number of elements to list, the worst first (10)",
                {.check = whole_number(0, 1000000)}},
               {"--time-limit",
                &request->time_limit,
                "time limit in seconds; no verdict is given after it",
                {.check = non_negative_number(kAnySeconds)}}});
  request->common.add_to(verb);
  verb.footer("Example: majorant mesh check part.msh -o bad.html");
  verb.callback([request, run] { *run = [request] { return mesh_check(*request); }; });
}

void add_mesh(CLI::App& app, Action* run) {
  CLI::App& verb =
      *app.add_subcommand("mesh", "check and optimize volume meshes, straight or curved");
  begin_group(verb, OptionGroup::General);
  verb.get_help_ptr()->group(verb.option_defaults()->get_group());
  verb.require_subcommand(1);
  add_mesh_check(verb, run);
  add_mesh_optimize(verb, run);
  verb.footer("Example: majorant mesh optimize part.msh -o better.msh");
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
