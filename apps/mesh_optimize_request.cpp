#include "apps/mesh_optimize_request.h"

#include <fmt/format.h>

#include <cmath>
#include <sstream>
#include <string_view>
#include <vector>

#include "apps/arguments/number_check.h"
#include "apps/arguments/option_table.h"
#include "apps/arguments/suggestion.h"
#include "apps/energy_option.h"
#include "majorant/energies/solid_energies.h"
#include "majorant/framework/error.h"
#include "majorant/io/files/input_file.h"

namespace majorant::app {
namespace {

constexpr std::string_view kSizeFrom = "size=";

// Reads edge lengths, numbers separated by space, for a mesh of dimension `dim`.
std::vector<double> read_sizes(const std::string& path, int dim, const StopCheck& stop) {
  std::string content = read_whole_file(path, stop);
  require_text(path, content);
  std::istringstream words(content);
  std::vector<double> sizes;
  for (std::string word; words >> word;) {
    char* end = nullptr;
    sizes.push_back(std::strtod(word.c_str(), &end));
    if (*end != '\0' || !is_edge_length(sizes.back(), dim))
      throw Error(
          ErrorKind::Unreadable,
          fmt::format("{}: {} is not an edge length: a positive number whose volume a double holds",
                      path, in_quotes(word)));
  }
  if (sizes.empty()) throw Error(ErrorKind::Unreadable, path + ": no edge lengths");
  return sizes;
}

}  // namespace

void MeshOptimizeRequest::add_to(CLI::App& verb) {
  const std::string versioned = majorant::in_words(extensions_for(FormatUse::WriteVersions), "or");
  add_options(
      verb, OptionGroup::Files,
      {{"input", &input, "mesh of volumes or of the plane: " + cells_help(), {.required = true}},
       {"-o,--output",
        &output,
        fmt::format(
            "the mesh with moved nodes, in the format, order and numbering of the input; or {}",
            fmt::join(extensions_for(FormatUse::WriteCells), ", ")),
        {.type = "FILE", .required = true}},
       {"--msh-version",
        &msh_version,
        fmt::format("version of a written {} (that of the input)", versioned),
        {.check = one_of({"2.2", "4.1"})}},
       {"--binary", &binary, fmt::format("write a {} as bytes (as the input)", versioned)}});
  add_options(
      verb, OptionGroup::Map,
      {{"--energy", &energy, "shape energy of the elements, a name listed below", {.type = "NAME"}},
       {"--target",
        &target,
        "target shape: ideal: regular, as large as the elements around it; initial: the input "
        "element, straightened; size=FILE: edge lengths, one in all or one for each element "
        "(ideal)",
        {.type = "ideal|initial|size=FILE"}},
       {"--list",
        &listed,
        "number of elements to list, the worst first (10)",
        {.check = whole_number(0, 1000000)}}});
  add_options(
      verb, OptionGroup::Constraints,
      {{"--boundary",
        &boundary,
        "which boundary nodes move: fixed: none; slide: within planes, along edges between planes, "
        "along curved sides; free: those of invalid elements and their neighbours (fixed)",
        {.check = one_of({"fixed", "slide", "free"})}}});
  add_options(
      verb, OptionGroup::Solver,
      {{"--tolerance",
        &tolerance,
        fmt::format("stop when the estimated decrease that is left is this part of the energy ({})",
                    tolerance),
        {.check = positive_number()}},
       {"--max-iterations",
        &max_iterations,
        fmt::format("limit of iterations after untangling ({})", max_iterations),
        {.check = whole_number(0)}},
       {"--time-limit",
        &time_limit,
        "time limit in seconds; the best valid mesh is written, if there is one",
        {.check = non_negative_number()}}});
  common.add_to(verb);
}

std::string MeshOptimizeRequest::size_file() const {
  return target.starts_with(kSizeFrom) ? target.substr(kSizeFrom.size()) : "";
}

void MeshOptimizeRequest::require_usable() const {
  if (target != "ideal" && target != "initial" && size_file().empty())
    throw Error(ErrorKind::Usage,
                fmt::format("--target {}: ideal, initial or size=FILE{}", in_quotes(target),
                            did_you_mean(target, {"ideal", "initial"})));
  if ((!msh_version.empty() || binary) && !is_for(FormatUse::WriteVersions, output))
    throw Error(ErrorKind::Usage,
                fmt::format("{}: --msh-version and --binary apply to {}", output,
                            majorant::in_words(extensions_for(FormatUse::WriteVersions), "and")));
}

VolumeOptions MeshOptimizeRequest::options(const VolumeMesh& mesh, const StopCheck& stop) const {
  VolumeOptions options;
  options.energy = parse_energy(energy, volume_energies(mesh.dimension()));
  options.tolerance = tolerance;
  if (boundary == "slide") options.boundary = VolumeBoundary::Slide;
  if (boundary == "free") options.boundary = VolumeBoundary::Free;
  if (target == "initial") options.target = VolumeTarget::Initial;
  if (target.starts_with(kSizeFrom)) {
    options.target = VolumeTarget::Size;
    const std::string path = target.substr(kSizeFrom.size());
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

GmshChoice MeshOptimizeRequest::gmsh() const {
  GmshChoice choice;
  if (!msh_version.empty())
    choice.version = msh_version == "2.2" ? GmshVersion::Old : GmshVersion::New;
  if (binary) choice.encoding = GmshEncoding::Binary;
  return choice;
}

Json MeshOptimizeRequest::to_json() const {
  return {{"energy", energy},
          {"target", target},
          {"boundary", boundary},
          {"tolerance", tolerance},
          {"max_iterations", max_iterations},
          {"strict", common.strict}};
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
