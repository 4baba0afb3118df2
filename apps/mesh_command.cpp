// majorant mesh check IN: which elements of a curved mesh are valid, proven; which sides of
// elements do not agree. docs/volumes.md. `mesh optimize` is in a file of its own.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <memory>

#include "apps/arguments/help_text.h"
#include "apps/arguments/number_check.h"
#include "apps/command.h"
#include "apps/mesh_verbs.h"
#include "apps/or_interrupted.h"
#include "apps/outputs.h"
#include "apps/page_content.h"
#include "apps/process.h"
#include "apps/progress.h"
#include "apps/streams.h"
#include "apps/within_memory.h"
#include "majorant/framework/parallel.h"
#include "majorant/io/waiting_output.h"
#include "majorant/results/volume_pictures.h"
#include "majorant/results/volume_report.h"
#include "majorant/volumes/check_volume_mesh.h"
#include "majorant/volumes/volume_files.h"

namespace majorant::app {
namespace {

struct MeshCheckRequest {
  CommonOptions common;
  std::string input;
  std::vector<std::string> outputs;
  int listed = 10;  // elements in the verdict and the report, at most
  double time_limit = std::numeric_limits<double>::infinity();
};

// "part.msh: valid: ...", then a line for each of the worst elements where some are not.
std::string verdict_of(const MeshCheckRequest& request, const VolumeMesh& mesh,
                       const VolumeCheck& check) {
  const Extremes all = extremes_of(check);
  const std::string faults = faults_in_words(mesh, check);
  std::string text = one_line(fmt::format(
      "{}: {}: {}{}; {}; min det J in [{:.4g}, {:.4g}], scaled Jacobian at least {:.4g}, {:.4g} in "
      "the mean\n",
      request.input, status_of(check), faults, faults.empty() ? "det J > 0 all over" : "",
      elements_in_words(mesh) + (check.is_surface ? ", against their straight normals" : ""),
      all.low, all.high, check.least_scaled_jacobian(), check.mean_scaled_jacobian()));
  return check.is_valid() ? text : text + bad_elements_in_words(mesh, check, request.listed);
}

Json report_of(const MeshCheckRequest& request, const VolumeMesh& mesh, const VolumeCheck& check) {
  const std::string faults = faults_in_words(mesh, check);
  Json report{{"schema_version", 1},
              {"version", MAJORANT_VERSION},
              {"command", "mesh check"},
              {"status", status_of(check)},
              {"message", faults.empty() ? "det J > 0 all over" : faults},
              {"input", {{"file", request.input}, {"points", mesh.points.rows()}}},
              {"mesh", mesh_section(mesh, check, request.listed)}};
  report["peak_memory_bytes"] = peak_memory_bytes();
  report["threads"] = ThreadCount::current();
  return report;
}

// The elements that are not proven to be valid as a .vtu; those that are listed as a page, or
// marked in a picture of all.
void write_elements(const std::string& path, const MeshCheckRequest& request,
                    const VolumeMesh& mesh, const VolumeCheck& check) {
  if (path.ends_with(".png"))
    return write_space_png(path, picture_of_elements(mesh, check, request.listed));
  if (!is_page(path)) {
    std::vector<const CheckedCell*> bad;
    for (const CheckedCell& cell : check.cells)
      if (cell.range.positive != ProofStatus::Proven) bad.push_back(&cell);
    return write_cells_vtu(path, mesh, bad);
  }
  MapPage page = page_of_elements(mesh, check.worst(to_size(request.listed)));
  page.title = page_title(request.input);
  page.facts = page_facts(report_of(request, mesh, check), {request.input});
  write_page(path, page);
}

int mesh_check(const MeshCheckRequest& request) {
  require_writable(request.common, {{request.outputs, {".vtu", ".html", ".png"}}}, {request.input});
  if (request.listed == 0 && has_page(request.outputs))
    throw Error(ErrorKind::Usage,
                "--list 0: a page shows the elements that are listed, one at least");
  const ThreadCount threads(usable_threads(request.common.threads));
  Progress progress(request.common, {Activity::Reading, Activity::Proving});
  const RunRecord record(request.time_limit, 0, interruption_flag(), &progress);
  const StopCheck& stop = record.stop();
  set_output_stop(stop);
  record.begin(Activity::Reading);
  const auto guarded = [&](const std::string& doing, const auto& work) {
    return or_interrupted(doing + " " + request.input,
                          [&] { return within_memory(request.input, work); });
  };
  const VolumeMesh mesh = guarded("reading", [&] { return read_volume_mesh(request.input, stop); });
  record.begin(Activity::Proving);
  const VolumeCheck check = guarded("checking", [&] { return check_volume_mesh(mesh, stop); });
  progress.finish();
  const bool is_valid = check.is_valid();
  if (!is_valid || !request.common.quiet) {
    const std::string text = verdict_of(request, mesh, check);
    request.common.report == kStandardOutput ? say_text(text) : print_text(text);
  }
  WrittenFiles written;
  for (const std::string& path : request.outputs)
    written.write(path, [&] { write_elements(path, request, mesh, check); });
  if (const std::string& path = request.common.report; !path.empty())
    written.write(path, [&] { write_json(path, report_of(request, mesh, check)); });
  return written.conclude(is_valid ? kSuccess : kInvalid);
}

}  // namespace

void add_mesh_check(CLI::App& mesh, Action* run) {
  auto request = std::make_shared<MeshCheckRequest>();
  CLI::App& verb = *mesh.add_subcommand("check", "prove which elements of a mesh are valid");
  begin_group(verb, OptionGroup::Files);
  verb.add_option("input", request->input,
                  "mesh of volumes or surfaces: .msh (2.2, 4.1), .mesh (MFEM, Medit), .vtu")
      ->required();
  verb.add_option("-o,--output", request->outputs,
                  "the elements that are not proven to be valid: .vtu; those that are listed, in a "
                  "page: .html, or marked in the mesh, cut open: .png; repeatable")
      ->type_name("FILE")
      ->allow_extra_args(false);
  begin_group(verb, OptionGroup::Map);
  verb.add_option("--list", request->listed, "elements that are listed, the worst first (10)")
      ->check(whole_number(0, 1000000));
  verb.add_option("--time-limit", request->time_limit, "seconds; nothing is said after that")
      ->check(non_negative_number(std::numeric_limits<double>::infinity()));
  request->common.add_to(verb);
  verb.footer("Example: majorant mesh check part.msh -o bad.html");
  verb.callback([request, run] { *run = [request] { return mesh_check(*request); }; });
}

void add_mesh(CLI::App& app, Action* run) {
  CLI::App& verb =
      *app.add_subcommand("mesh", "check and optimize meshes of volumes, straight or curved");
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
