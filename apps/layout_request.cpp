#include "apps/layout_request.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <set>
#include <vector>

#include "apps/arguments/number_check.h"
#include "apps/arguments/option_table.h"
#include "apps/arguments/suggestion.h"
#include "majorant/apps/jobs/obj_layout.h"
#include "majorant/framework/error.h"
#include "majorant/io/read_densities.h"

namespace majorant::app {
namespace {

// Returns the message about a word that is neither a density nor a file.
std::string wrong_density(const std::string& word) {
  const std::optional<double> number = number_in(word);
  std::error_code ignored;
  if (number ? *number > 0 && std::isfinite(*number) : std::filesystem::exists(word, ignored))
    return {};
  return fmt::format("'{}' is not a file or a positive number of pixels", word);
}

// Returns the density of each polygon.
std::vector<double> densities(const std::string& path, const PolygonMesh& polygons,
                              const StopCheck& stop) {
  const MaterialDensities table = read_densities(path, stop);
  const std::vector<std::string> materials = material_of_polygons(polygons);
  const std::set<std::string> known(materials.begin(), materials.end());
  for (const auto& [name, density] : table.materials)
    if (!known.contains(name))
      throw Error(ErrorKind::Usage, fmt::format("{}: {} has no material '{}'; correct the name",
                                                path, polygons.file, name));
  std::vector<double> list;
  for (const std::string& material : materials) {
    const auto found = table.materials.find(material);
    if (found == table.materials.end() && !table.other)
      throw Error(ErrorKind::Usage,
                  fmt::format("{}: says nothing of {}; add it, or \"other\"", path,
                              material.empty() ? "faces without a material"
                                               : fmt::format("material '{}'", material)));
    list.push_back(found != table.materials.end() ? found->second : *table.other);
  }
  return list;
}

}  // namespace

void LayoutRequest::add_to(CLI::App& verb) {
  add_options(verb, OptionGroup::Charts,
              {{"--upright",
                &upright,
                "axis of the mesh that points upwards in every chart; charts are then not turned "
                "further (no)",
                {.check = one_of({"x", "y", "z", "no"}), .excludes = {"--no-pack"}}},
               {"--udim",
                &udim,
                "use up to N UDIM tiles, from 1001 on, all at one texel density; an OBJ gets a "
                "material for each",
                {.check = whole_number(1, kMaxTiles), .excludes = {"--no-pack"}}},
               {"--texel-density",
                &texel_density,
                "pixels per unit of the mesh: a number, or a JSON FILE {\"materials\": {\"NAME\": "
                "X}, \"other\": X}",
                {.type = "X|FILE", .check = checked_by(wrong_density), .excludes = {"--no-pack"}}},
               {"--stack",
                &stack,
                "charts that share a place: equal: copies of one surface; mirrored: mirror images, "
                "too; no: none (no)",
                {.check = one_of({"no", "equal", "mirrored"}), .excludes = {"--no-pack"}}},
               {"--keep-shape",
                &keep_shape,
                "only pack: move and turn the islands of --seams uv, all at one scale",
                {.excludes = {"--no-pack"}}},
               {"--objects",
                &objects,
                "separate: each object of an OBJ (o) or mesh of a glTF has its own layout in the "
                "unit square; together: all share one (together)",
                {.check = one_of({"together", "separate"}), .excludes = {"--no-pack"}}},
               {"--groups", &groups, "OBJ: write each chart as a group, chart_0 and on"}});
}

std::string LayoutRequest::density_file() const {
  return number_in(texel_density) ? "" : texel_density;
}

std::string LayoutRequest::needs_unit_square() const {
  if (udim > 0) return "--udim";
  return texel_density.empty() ? "" : "--texel-density";
}

void LayoutRequest::apply(AtlasJob& job, const StopCheck& stop) const {
  if (keep_shape) job.options.islands = Islands::Kept;
  if (stack != "no") job.options.stacking = stack == "equal" ? Stacking::Equal : Stacking::Mirrored;
  if (!job.options.packing) return;
  if (upright != "no") job.options.packing->up = Vector3::Unit(upright[0] - 'x');
  if (udim > 0) job.options.packing->tiles = udim;
  if (texel_density.empty()) return;
  const std::string file = density_file();
  job.texel_density = file.empty() ? std::vector<double>(job.polygons->polygons.size(),
                                                         number_in(texel_density).value_or(0))
                                   : densities(file, *job.polygons, stop);
}

Json LayoutRequest::to_json() const {
  const std::optional<double> density = number_in(texel_density);
  return {{"upright", upright},
          {"udim", udim == 0 ? Json() : Json(udim)},
          {"texel_density", density ? Json(*density) : Json(texel_density)},
          {"stack", stack},
          {"keep_shape", keep_shape},
          {"objects", objects},
          {"groups", groups}};
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
