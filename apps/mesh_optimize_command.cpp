// majorant mesh optimize IN -o OUT: untangles the elements of a mesh and gives them better shapes.
// What is written is proven, from its bytes, to have valid elements alone. docs/volumes.md.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <cmath>
#include <memory>
#include <ranges>
#include <sstream>

#include "apps/arguments/number_check.h"
#include "apps/arguments/option_table.h"
#include "apps/arguments/suggestion.h"
#include "apps/energy_option.h"
#include "apps/mesh_verbs.h"
#include "apps/outputs.h"
#include "apps/run.h"
#include "apps/streams.h"
#include "majorant/energies/solid_energies.h"
#include "majorant/io/input_file.h"
#include "majorant/results/volume_report.h"
#include "majorant/volumes/optimize_volume_mesh.h"
#include "majorant/volumes/volume_files.h"

namespace majorant::app {
namespace {

struct MeshOptimizeRequest {
  CommonOptions common;
  std::string input, output;
  std::string energy = "symmetric-dirichlet", target = "ideal", boundary = "fixed";
  int listed = 10;  // elements in messages and the report, at most
  double tolerance = VolumeOptions().tolerance;
  int max_iterations = StoppingRules().max_iterations;
  double time_limit = std::numeric_limits<double>::infinity();
  std::string msh_version;  // or empty: as the input
  bool binary = false;
};

constexpr std::string_view kSizeFrom = "size=";

// Numbers with space between them: edge lengths, of a mesh of so many dimensions.
std::vector<double> read_sizes(const std::string& path, int dim, const StopCheck& stop) {
  std::string content = read_whole_file(path, stop);
  require_text(path, content);
  std::istringstream words(content);
  std::vector<double> sizes;
  for (std::string word; words >> word;) {
    char* end = nullptr;
    sizes.push_back(std::strtod(word.c_str(), &end));
    if (*end != '\0' || !is_edge_length(sizes.back(), dim))
      throw Error(ErrorKind::Unreadable,
                  fmt::format("{}: {} is no edge length, a positive number of which doubles hold "
                              "the volume",
                              path, in_quotes(word)));
  }
  if (sizes.empty()) throw Error(ErrorKind::Unreadable, path + ": no edge lengths");
  return sizes;
}

VolumeOptions options_of(const MeshOptimizeRequest& request, const VolumeMesh& mesh,
                         const StopCheck& stop) {
  VolumeOptions options;
  options.energy = parse_energy(request.energy, volume_energies(mesh.dimension()));
  options.tolerance = request.tolerance;
  if (request.boundary == "slide") options.boundary = VolumeBoundary::Slide;
  if (request.boundary == "free") options.boundary = VolumeBoundary::Free;
  if (request.target == "initial") options.target = VolumeTarget::Initial;
  if (request.target.starts_with(kSizeFrom)) {
    options.target = VolumeTarget::Size;
    const std::string path = request.target.substr(kSizeFrom.size());
    options.sizes = read_sizes(path, mesh.dimension(), stop);
    std::size_t cells = 0;
    for (const CellBlock& block : mesh.blocks)
      if (dimension(block.type.shape) == mesh.dimension()) cells += to_size(block.size());
    if (options.sizes.size() != 1 && options.sizes.size() != cells)
      throw Error(ErrorKind::Unreadable,
                  fmt::format("{}: {} edge lengths for {} elements; give one, or one for each",
                              path, options.sizes.size(), cells));
  }
  return options;
}

// The file that --target names; empty where it is one of the words.
std::string size_file(const MeshOptimizeRequest& request) {
  return request.target.starts_with(kSizeFrom) ? request.target.substr(kSizeFrom.size()) : "";
}

void require_usable(const MeshOptimizeRequest& request) {
  const std::string& target = request.target;
  if (target != "ideal" && target != "initial" && size_file(request).empty())
    throw Error(ErrorKind::Usage,
                fmt::format("--target {}: ideal, initial or size=FILE{}", in_quotes(target),
                            did_you_mean(target, {"ideal", "initial"})));
  if ((!request.msh_version.empty() || request.binary) && format_of(request.output) != ".msh")
    throw Error(ErrorKind::Usage,
                fmt::format("{}: --msh-version and --binary are of .msh", request.output));
}

// "part.msh: converged: 384 tetrahedra of degree 2; 25 were not valid, none is left; energy ..."
std::string summary_of(const MeshOptimizeRequest& request, const VolumeMesh& mesh,
                       const VolumeResult& result) {
  const VolumeCheck &before = result.before, &after = result.after;
  const auto count = static_cast<Index>(before.cells.size());
  const Index bad = count - before.count(ProofStatus::Proven);
  std::string text =
      fmt::format("{}: {}: {}", request.input, status_name(result.status), elements_in_words(mesh));
  if (!result.is_valid()) {
    const char* remedy = request.boundary == "free" || result.status != Status::Infeasible ? ""
                         : result.impossible.empty() ? "; --boundary free moves the boundary, too"
                                                     : "; --boundary free moves these nodes, too";
    return text + fmt::format("; {}; no mesh is written{}", result.message, remedy);
  }
  if (bad > 0)
    text += fmt::format("; {} {} not valid, none is left", bad, bad == 1 ? "was" : "were");
  text += fmt::format(
      "; energy {:.6g} to {:.6g}; scaled Jacobian at least {:.4g}, {:.4g} in the mean, before "
      "{:.4g} and {:.4g}",
      result.initial_value, result.value, after.least_scaled_jacobian(),
      after.mean_scaled_jacobian(), before.least_scaled_jacobian(), before.mean_scaled_jacobian());
  if (result.least_fell()) {
    text += "; the least one fell";
    if (request.energy != "amips-exponential")
      text += ", --energy amips-exponential weighs the worst elements most";
    if (request.target != "initial") text += ", --target initial keeps nearer to what elements are";
  }
  text += fmt::format("; {} nodes moved", result.moved_nodes);
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

GmshChoice choice_of(const MeshOptimizeRequest& request) {
  GmshChoice choice;
  if (!request.msh_version.empty())
    choice.version = request.msh_version == "2.2" ? GmshVersion::Old : GmshVersion::New;
  if (request.binary) choice.encoding = GmshEncoding::Binary;
  return choice;
}

// Throws Error(Invalid) unless what was written, read back, is a mesh of valid elements.
void write(const MeshOptimizeRequest& request, const VolumeMesh& mesh) {
  std::vector<std::string> left_out;
  write_volume_mesh(
      request.output, mesh, choice_of(request), &left_out, [&](const VolumeMesh& written) {
        if (!check_volume_mesh(written).is_valid())
          throw Error(ErrorKind::Invalid,
                      request.output + ": what would be written is not proven to be valid");
      });
  if (!request.common.quiet) say_left_out(request.output, left_out);
}

Made optimized(const MeshOptimizeRequest& request, VolumeMesh& mesh, Run& run) {
  mesh = run.read(request.input, [&] { return read_volume_mesh(request.input, run.start_stop()); });
  require_volume_format(request.output, mesh, choice_of(request));
  const VolumeOptions options = run.make(
      "reading " + size_file(request), [&] { return options_of(request, mesh, run.start_stop()); });
  const VolumeResult result = run.make("optimizing " + request.input, [&] {
    return within_memory(request.input,
                         [&] { return optimize_volume_mesh(mesh, options, run.record()); });
  });
  mesh.points = result.points;  // those that are written, or that failed
  Made made{.report = optimized_mesh_report(mesh, result, run.record(), request.listed)};
  made.report.options = {{"energy", request.energy},
                         {"target", request.target},
                         {"boundary", request.boundary},
                         {"tolerance", request.tolerance},
                         {"max_iterations", request.max_iterations},
                         {"strict", request.common.strict}};
  made.report.result["energy"] = request.energy;
  const std::string text = summary_of(request, mesh, result);
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
  require_usable(request);
  const RunPlan plan{.command = "mesh optimize",
                     .common = request.common,
                     .inputs = {request.input, size_file(request)},
                     .outputs = {{{request.output}, {".msh", ".mesh", ".vtu"}}},
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
  MeshOptimizeRequest& r = *request;
  add_options(
      verb, OptionGroup::Files,
      {{"input",
        &r.input,
        "mesh of volumes or of the plane: .msh (2.2, 4.1), .mesh (MFEM, Medit), .vtu",
        {.required = true}},
       {"-o,--output",
        &r.output,
        "the mesh with moved nodes, in the format, order and numbers of the input; or .msh, .vtu",
        {.type = "FILE", .required = true}},
       {"--msh-version",
        &r.msh_version,
        "of a .msh that is written (the input's)",
        {.check = one_of({"2.2", "4.1"})}},
       {"--binary", &r.binary, "a .msh is written as bytes (as the input)"}});
  add_options(
      verb, OptionGroup::Map,
      {{"--energy", &r.energy, "what elements lose by their shape, listed below", {.type = "NAME"}},
       {"--target",
        &r.target,
        "what they should look like: ideal, regular of the size of what is around them; initial, "
        "as straight as they are; size=FILE, edge lengths, one or one for each",
        {.type = "ideal|initial|size=FILE"}},
       {"--list",
        &r.listed,
        "elements that are listed, the worst first (10)",
        {.check = whole_number(0, 1000000)}}});
  add_options(verb, OptionGroup::Constraints,
              {{"--boundary",
                &r.boundary,
                "fixed; slide: planes move in themselves, their edges along themselves; free",
                {.check = one_of({"fixed", "slide", "free"})}}});
  add_options(verb, OptionGroup::Solver,
              {{"--tolerance",
                &r.tolerance,
                fmt::format("part of the energy that may be left, estimated ({})", r.tolerance),
                {.check = positive_number()}},
               {"--max-iterations",
                &r.max_iterations,
                fmt::format("after untangling ({})", r.max_iterations),
                {.check = whole_number(0)}},
               {"--time-limit",
                &r.time_limit,
                "seconds; the best valid mesh is written, if there is one",
                {.check = non_negative_number()}}});
  request->common.add_to(verb);
  verb.footer(energy_help(solid_energies()) +
              "Example: majorant mesh optimize part.msh -o better.msh --boundary slide");
  verb.callback([request, run] { *run = [request] { return mesh_optimize(*request); }; });
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
