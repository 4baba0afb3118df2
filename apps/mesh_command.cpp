// majorant mesh check IN: which elements of a curved mesh are valid, proven; which sides of
// elements do not agree. docs/volumes.md.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <cmath>
#include <map>
#include <memory>
#include <set>

#include "apps/arguments/help_text.h"
#include "apps/arguments/number_check.h"
#include "apps/command.h"
#include "apps/or_interrupted.h"
#include "apps/outputs.h"
#include "apps/process.h"
#include "apps/progress.h"
#include "apps/streams.h"
#include "apps/within_memory.h"
#include "majorant/framework/parallel.h"
#include "majorant/io/waiting_output.h"
#include "majorant/results/report.h"
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

// "384 tetrahedra of degree 2, 8 wedges of degree 1": of the cells that are checked.
std::string elements_in_words(const VolumeMesh& mesh) {
  std::string text;
  for (const CellBlock& block : mesh.blocks)
    if (dimension(block.type.shape) == mesh.dimension())
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", block.size(), describe(block.type));
  return text;
}

std::string name_of(const VolumeMesh& mesh, CellName name) {
  const CellBlock& block = mesh.blocks[to_size(name.block)];
  return fmt::format("{}", block.numbers[to_size(name.cell)]);
}

const char* status_of(const VolumeCheck& check) {
  if (check.invalid() > 0 || !check.disagreements.empty() || !check.crowded.empty())
    return "invalid";
  return check.undecided() > 0 ? "undecided" : "valid";
}

// What is wrong, in words; empty where nothing is.
std::string faults_in_words(const VolumeMesh& mesh, const VolumeCheck& check) {
  std::vector<std::string> faults;
  const auto count = static_cast<Index>(check.cells.size());
  if (check.inverted() == count)
    faults.push_back(
        fmt::format("all {} elements are turned around, det J < 0 all over them", count));
  else if (check.invalid() > 0)
    faults.push_back(fmt::format(
        "{} of {} elements have det J <= 0 somewhere{}", check.invalid(), count,
        check.inverted() > 0 ? fmt::format(", {} of them everywhere", check.inverted()) : ""));
  if (check.undecided() > 0)
    faults.push_back(fmt::format("{} of {} elements are not decided", check.undecided(), count));
  if (!check.disagreements.empty()) {
    const Disagreement& first = check.disagreements.front();
    faults.push_back(
        fmt::format("{} shared side{} not the same in both elements, first of {} and {}",
                    check.disagreements.size(), check.disagreements.size() == 1 ? " is" : "s are",
                    name_of(mesh, first.first), name_of(mesh, first.second)));
  }
  if (!check.crowded.empty())
    faults.push_back(fmt::format(
        "{} side{} more than two elements, first of {}", check.crowded.size(),
        check.crowded.size() == 1 ? " has" : "s have", name_of(mesh, check.crowded.front())));
  return fmt::format("{}", fmt::join(faults, "; "));
}

struct Extremes {
  double low = std::numeric_limits<double>::infinity(), high = low, largest = -low;
};

Extremes extremes_of(const VolumeCheck& check) {
  Extremes all;
  for (const CheckedCell& cell : check.cells) {
    all.low = std::min(all.low, cell.range.low);
    all.high = std::min(all.high, cell.range.high);
    all.largest = std::max(all.largest, cell.range.largest);
  }
  return all;
}

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
  if (check.is_valid()) return text;
  for (const CheckedCell* cell : check.worst(to_size(request.listed))) {
    if (cell->range.positive == ProofStatus::Proven) break;
    const CellBlock& block = mesh.blocks[to_size(cell->name.block)];
    const Vector3 place = place_of(mesh, *cell);
    text += fmt::format(
        "  element {} ({}, region {}): min det J in [{:.6g}, {:.6g}] at ({:.6g}, {:.6g}, {:.6g}), "
        "scaled Jacobian {:.4g}{}\n",
        name_of(mesh, cell->name), plural_of(block.type.shape),
        block.regions[to_size(cell->name.cell)], cell->range.low, cell->range.high, place.x(),
        place.y(), place.z(), cell->scaled_jacobian,
        cell->range.positive == ProofStatus::Undecided ? ", undecided" : "");
  }
  return text;
}

Json element_section(const VolumeMesh& mesh, const CheckedCell& cell) {
  const CellBlock& block = mesh.blocks[to_size(cell.name.block)];
  const Vector3 place = place_of(mesh, cell);
  const char* const answer = cell.range.positive == ProofStatus::Proven     ? "valid"
                             : cell.range.positive == ProofStatus::Violated ? "invalid"
                                                                            : "undecided";
  return {{"element", block.numbers[to_size(cell.name.cell)]},
          {"type", std::string(plural_of(block.type.shape))},
          {"region", block.regions[to_size(cell.name.cell)]},
          {"verdict", answer},
          {"min_det", {cell.range.low, cell.range.high}},
          {"max_det", {cell.range.largest_low, cell.range.largest}},
          {"scaled_jacobian", cell.scaled_jacobian},
          {"at", {place.x(), place.y(), place.z()}}};
}

Json report_of(const MeshCheckRequest& request, const VolumeMesh& mesh, const VolumeCheck& check) {
  std::map<std::string, Index> elements;
  std::set<int> orders;
  for (const CellBlock& block : mesh.blocks) {
    elements[std::string(plural_of(block.type.shape))] += block.size();
    if (dimension(block.type.shape) == mesh.dimension()) orders.insert(block.type.degree);
  }
  Json worst = Json::array(), disagreements = Json::array();
  for (const CheckedCell* cell : check.worst(to_size(request.listed)))
    worst.push_back(element_section(mesh, *cell));
  const auto number = [&](CellName name) {
    return mesh.blocks[to_size(name.block)].numbers[to_size(name.cell)];
  };
  for (const Disagreement& d : check.disagreements) {
    if (disagreements.size() == to_size(request.listed)) break;
    disagreements.push_back({number(d.first), number(d.second)});
  }
  const Extremes all = extremes_of(check);
  const std::string faults = faults_in_words(mesh, check);
  Json report{{"schema_version", 1},
              {"version", MAJORANT_VERSION},
              {"command", "mesh check"},
              {"status", status_of(check)},
              {"message", faults.empty() ? "det J > 0 all over" : faults},
              {"input", {{"file", request.input}, {"points", mesh.points.rows()}}},
              {"mesh",
               {{"elements", elements},
                {"orders", orders},
                {"checked", check.cells.size()},
                {"valid", check.count(ProofStatus::Proven)},
                {"invalid", check.invalid()},
                {"undecided", check.undecided()},
                {"inverted", check.inverted()},
                {"disagreeing_sides", check.disagreements.size()},
                {"crowded_sides", check.crowded.size()},
                {"boundary_sides", check.boundary_sides},
                {"min_det", {all.low, all.high}},
                {"max_det", all.largest},
                {"min_scaled_jacobian", check.least_scaled_jacobian()},
                {"mean_scaled_jacobian", check.mean_scaled_jacobian()},
                {"worst", worst},
                {"disagreements", disagreements}}}};
  report["peak_memory_bytes"] = peak_memory_bytes();
  report["threads"] = ThreadCount::current();
  return report;
}

int mesh_check(const MeshCheckRequest& request) {
  require_writable(request.common, {{request.outputs, {".vtu"}}}, {request.input});
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
  std::vector<const CheckedCell*> bad;
  for (const CheckedCell& cell : check.cells)
    if (cell.range.positive != ProofStatus::Proven) bad.push_back(&cell);
  for (const std::string& path : request.outputs)
    written.write(path, [&] { write_cells_vtu(path, mesh, bad); });
  if (const std::string& path = request.common.report; !path.empty())
    written.write(path, [&] { write_json(path, report_of(request, mesh, check)); });
  return written.conclude(is_valid ? kSuccess : kInvalid);
}

void add_mesh_check(CLI::App& mesh, Action* run) {
  auto request = std::make_shared<MeshCheckRequest>();
  CLI::App& verb = *mesh.add_subcommand("check", "prove which elements of a mesh are valid");
  begin_group(verb, OptionGroup::Files);
  verb.add_option("input", request->input,
                  "mesh of volumes or surfaces: .msh (2.2, 4.1), .mesh (MFEM, Medit), .vtu")
      ->required();
  verb.add_option("-o,--output", request->outputs,
                  "the elements that are not proven to be valid: .vtu, repeatable")
      ->type_name("FILE")
      ->allow_extra_args(false);
  begin_group(verb, OptionGroup::Map);
  verb.add_option("--list", request->listed, "elements that are listed, the worst first (10)")
      ->check(whole_number(0, 1000000));
  verb.add_option("--time-limit", request->time_limit, "seconds; nothing is said after that")
      ->check(non_negative_number(std::numeric_limits<double>::infinity()));
  request->common.add_to(verb);
  verb.footer("Example: majorant mesh check part.msh -o bad.vtu");
  verb.callback([request, run] { *run = [request] { return mesh_check(*request); }; });
}

}  // namespace

void add_mesh(CLI::App& app, Action* run) {
  CLI::App& verb = *app.add_subcommand("mesh", "check meshes of volumes, straight or curved");
  begin_group(verb, OptionGroup::General);
  verb.get_help_ptr()->group(verb.option_defaults()->get_group());
  verb.require_subcommand(1);
  add_mesh_check(verb, run);
  verb.footer("Example: majorant mesh check part.msh -o bad.vtu");
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
