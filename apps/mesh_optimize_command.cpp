// majorant mesh optimize IN -o OUT: untangles the elements of a mesh and improves their shapes. The
// written bytes are read back and proven to have valid elements only. See docs/volumes.md.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <memory>
#include <ranges>

#include "apps/energy_option.h"
#include "apps/mesh_optimize_request.h"
#include "apps/mesh_verbs.h"
#include "apps/outputs.h"
#include "apps/run.h"
#include "apps/streams.h"
#include "majorant/apps/jobs/volume_report.h"
#include "majorant/energies/solid_energies.h"
#include "majorant/io/volume_files.h"
#include "majorant/volumes/optimize_volume_mesh.h"
#include "majorant/volumes/turned_cells.h"

namespace majorant::app {
namespace {

// Returns "part.msh: converged: 384 tetrahedra of degree 2; 25 were not valid, none is left; energy
// ...". turned: the number of elements that were turned over first.
std::string summary_of(const MeshOptimizeRequest& request, const VolumeMesh& mesh,
                       const VolumeResult& result, Index turned) {
  const VolumeCheck &before = result.before, &after = result.after;
  const auto count = static_cast<Index>(before.cells.size());
  const Index bad = count - before.count(ProofStatus::Proven);
  std::string text =
      fmt::format("{}: {}: {}", request.input, status_name(result.status), elements_in_words(mesh));
  if (turned > 0)
    text += fmt::format("; {} {} turned around, {} nodes are now listed in the opposite order",
                        turned, turned == 1 ? "was" : "were", turned == 1 ? "its" : "their");
  if (!result.is_valid()) {
    const char* remedy = request.boundary == "free" || result.status != Status::Infeasible ? ""
                         : result.impossible.empty() ? "; --boundary free moves the boundary, too"
                                                     : "; --boundary free moves these nodes, too";
    return text + fmt::format("; {}; no mesh is written{}", result.message, remedy);
  }
  if (bad > 0)
    text += fmt::format("; {} {} not valid, none is left", bad, bad == 1 ? "was" : "were");
  text += fmt::format(
      "; energy {:.6g} to {:.6g}; scaled Jacobian at least {:.4g}, mean {:.4g}, before {:.4g} and "
      "{:.4g}",
      result.initial_value, result.value, after.least_scaled_jacobian(),
      after.mean_scaled_jacobian(), before.least_scaled_jacobian(), before.mean_scaled_jacobian());
  if (result.least_fell()) {
    text += "; the least one fell";
    if (request.energy != "amips-exponential")
      text += ", --energy amips-exponential weighs the worst elements most";
    if (request.target != "initial") text += ", --target initial keeps nearer to what elements are";
  }
  text += fmt::format("; {} node{} moved{}", result.moved_nodes, result.moved_nodes == 1 ? "" : "s",
                      result.moved_nodes == 0
                          ? ""
                          : fmt::format(", by {:.4g} at most", result.largest_displacement));
  return text;
}

std::string impossible_in_words(const VolumeMesh& mesh, const VolumeResult& result, int listed) {
  std::string text;
  for (const CellName& name : result.impossible) {
    if (listed-- == 0) break;
    const CellBlock& block = mesh.blocks[to_size(name.block)];
    text += fmt::format(
        "  element {} ({}, region {}): impossible, its held nodes make det J <= 0\n",
        name_of(mesh, name), plural_of(block.type.shape), block.regions[to_size(name.cell)]);
  }
  return text;
}

// Writes the mesh and reads it back. Throws Error(Invalid) unless it has valid elements only.
void write(const MeshOptimizeRequest& request, const VolumeMesh& mesh) {
  std::vector<std::string> left_out;
  write_volume_mesh(
      request.output, mesh, request.gmsh(), &left_out, [&](const VolumeMesh& written) {
        if (!check_volume_mesh(written).is_valid())
          throw Error(ErrorKind::Invalid,
                      request.output + ": what would be written is not proven to be valid");
      });
  if (!request.common.quiet) say_left_out(request.output, left_out);
}

Made optimized(const MeshOptimizeRequest& request, VolumeMesh& mesh, Run& run) {
  mesh = run.read(request.input, [&] { return read_volume_mesh(request.input, run.start_stop()); });
  require_volume_format(request.output, mesh, request.gmsh());
  const VolumeOptions options = run.make("reading " + request.size_file(),
                                         [&] { return request.options(mesh, run.start_stop()); });
  const double before = run.seconds();
  const std::vector<CellName> turned = run.make("turning elements of " + request.input, [&] {
    std::vector<CellName> cells = turned_cells(mesh, run.start_stop());
    mesh = with_cells_turned(mesh, cells, run.start_stop());
    return cells;
  });
  const VolumeResult result = run.make("optimizing " + request.input, [&] {
    return within_memory(request.input,
                         [&] { return optimize_volume_mesh(mesh, options, run.record()); });
  });
  mesh.points = result.points;  // the written points, or those of the failure
  Made made{.report = optimized_mesh_report(mesh, result, run.record(), request.listed)};
  made.report.input["turned"] = turned.size();
  made.report.seconds["optimize"] = run.seconds() - before;
  made.report.options = request.to_json();
  made.report.result["energy"] = request.energy;
  const std::string text = summary_of(request, mesh, result, static_cast<Index>(turned.size()));
  if (result.is_valid()) {
    made.files.push_back({request.output, [&] { write(request, mesh); }});
    made.summary = [text](const WrittenFiles&) { return std::vector<std::string>{text}; };
    return made;
  }
  made.code = kInvalid;
  made.faults = {text};
  const std::string bad = result.impossible.empty()
                              ? bad_elements_in_words(mesh, result.after, request.listed)
                              : impossible_in_words(mesh, result, request.listed);
  for (const auto line : std::views::split(bad, '\n'))
    if (!line.empty()) made.faults.emplace_back(line.begin(), line.end());
  return made;
}

int mesh_optimize(const MeshOptimizeRequest& request) {
  request.require_usable();
  const RunPlan plan{.command = "mesh optimize",
                     .common = request.common,
                     .inputs = {request.input, request.size_file()},
                     .outputs = {{{request.output}, extensions_for(FormatUse::ReadCells)}},
                     .stages = {Activity::Reading, Activity::Proving, Activity::Starting,
                                Activity::Solving, Activity::Proving, Activity::Writing},
                     .time_limit = request.time_limit,
                     .max_iterations = request.max_iterations,
                     .with_result = {Activity::Solving, Activity::Proving, Activity::Writing}};
  VolumeMesh mesh;
  return run_verb(plan, [&](Run& run) { return optimized(request, mesh, run); });
}

}  // namespace

void add_mesh_optimize(CLI::App& mesh, Action* run) {
  auto request = std::make_shared<MeshOptimizeRequest>();
  CLI::App& verb =
      *mesh.add_subcommand("optimize", "untangle the elements of a mesh and improve their shapes");
  request->add_to(verb);
  verb.footer(energy_help(solid_energies()) +
              "Example: majorant mesh optimize part.msh -o better.msh --boundary slide");
  verb.callback([request, run] { *run = [request] { return mesh_optimize(*request); }; });
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
