#include "apps/unwrap/unwrap_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "apps/arguments/number_check.h"
#include "apps/arguments/option_table.h"
#include "apps/arguments/suggestion.h"
#include "apps/linear_solvers.h"
#include "apps/parts.h"
#include "majorant/apps/jobs/layout_presets.h"
#include "majorant/apps/jobs/model_texture.h"
#include "majorant/framework/error.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/files/standard_stream.h"
#include "majorant/io/io.h"
#include "majorant/pictures/images/image_file.h"

namespace majorant::app {
namespace {

constexpr const char* kAutomaticWeld = "auto";
constexpr const char* kNoWeld = "no";
constexpr const char* kAutomaticCharts = "auto";
constexpr const char* kOneChart = "one";

std::vector<std::string> preset_names() {
  std::vector<std::string> names;
  for (const LayoutPreset& preset : kLayoutPresets) names.emplace_back(preset.name);
  return names;
}

// The number of charts that the word is; none for the other words.
std::optional<Index> chart_count(const std::string& word) {
  Index count = 0;
  if (word == kAutomaticCharts || word == kOneChart || !CLI::detail::lexical_cast(word, count))
    return std::nullopt;
  return count;
}

// The message about what is neither.
std::string wrong_charts(const std::string& word) {
  if (word == kAutomaticCharts || word == kOneChart || chart_count(word).value_or(0) > 0) return {};
  return fmt::format("'{}' is neither auto nor one nor a number from 1 on", word);
}

std::string wrong_direction(const std::string& word) {
  if (direction_in(word)) return {};
  return fmt::format("'{}' is no direction; give that to the eye, not 0,0,0: 1,0.5,2", word);
}

std::string wrong_fill(const std::string& word) {
  const double fill = number_in(word).value_or(1);
  if (fill >= 0 && fill < 1) return {};
  return fmt::format("'{}' is no part of a square, from 0 on and below 1", word);
}

// The distance that the word is; none for the other words.
std::optional<double> weld_distance(const std::string& word) {
  if (word == kAutomaticWeld || word == kNoWeld) return std::nullopt;
  return number_in(word);
}

// The message about what is neither.
std::string wrong_weld(const std::string& word) {
  if (word == kAutomaticWeld || word == kNoWeld) return {};
  const std::optional<double> distance = weld_distance(word);
  if (distance && *distance >= 0 && std::isfinite(*distance)) return {};
  return fmt::format("'{}' is neither auto nor no nor a distance from 0 on", word);
}

}  // namespace

void UnwrapRequest::add_to(CLI::App& verb) {
  verb_ = &verb;
  seams.add_to(verb);
  add_options(
      verb, OptionGroup::Charts,
      {{"--padding",
        &padding,
        fmt::format("pixels between charts, and around them, at least ({})", padding),
        {.check = non_negative_number()}},
       {"--resolution",
        &resolution,
        fmt::format("pixels along the side of the layout ({})", resolution),
        {.check = positive_number()}},
       {"--scale",
        &scale,
        "unit (default): the layout lies in the unit square; model (default with --pins or "
        "--handles): a unit of it is one of the mesh",
        {.check = one_of({"unit", "model"})}},
       {"--no-pack",
        &no_pack,
        "leave charts where they are, also on top of each other",
        {.excludes = {"--padding", "--resolution"}}},
       {"--bake",
        &bake,
        "move the texture to the new layout, which is that of --normalize: of an OBJ (map_Kd and "
        "other maps) to OUT.png and OUT.mtl beside OUT.obj, or into OUT.glb; of a GLB (base "
        "colours) into OUT.glb; as large as --resolution says, or as the images together",
        {.excludes = {"--no-pack"}}},
       {"--uv-set",
        &uv_set,
        "set of texture coordinates of .glb and .gltf that the layout becomes: 0, where the old "
        "one moves to the next set if materials show it, or 1, which leaves it alone (0; lightmap: "
        "1)",
        {.type = "0|1", .check = CLI::IsMember({0, 1})}},
       {"--weld",
        &weld,
        "what is one surface for the map: auto, what lies edge on edge at equal positions (of "
        "--seams uv and FILE only where no face shares a vertex); no, nothing; or vertices no "
        "farther apart than a DISTANCE",
        {.type = "auto|no|DISTANCE", .check = checked_by(wrong_weld)}},
       {"--charts",
        &charts,
        "auto: as many as --max-stretch needs, long thin ones divided; one: what --seams says, "
        "whatever it stretches; N: so many, where fewer would do (auto)",
        {.type = "auto|one|N", .check = checked_by(wrong_charts)}},
       {"--fill",
        &fill,
        fmt::format("divide charts until they fill this part of the square, below 1, if they can; "
                    "0: for no fill (up to {:g} where that takes little seam)",
                    kUsualFill),
        {.check = checked_by(wrong_fill), .excludes = {"--no-pack"}}},
       {"--hide-from",
        &hide_from,
        "auto, sharp: seams out of sight of who looks from this direction (of all sides)",
        {.type = "X,Y,Z", .check = checked_by(wrong_direction)}},
       {"--preset",
        &preset,
        "defaults of --max-stretch, --charts, --fill, --padding and --resolution for: paint, few "
        "seams; lightmap; game; single, a chart for each piece",
        {.check = one_of(preset_names())}},
       {"--keep-seams", &keep_seams,
        "cut along the seams of the file's texture coordinates, too"}});
  layout.add_to(verb);
}

void UnwrapRequest::use_preset() {
  for (const LayoutPreset& p : kLayoutPresets) {
    if (p.name != preset) continue;
    if (!seams.max_stretch && seams.divides()) seams.max_stretch = p.max_stretch;
    if (!is_said("--charts") && seams.divides())
      charts = p.is_one_chart ? kOneChart : kAutomaticCharts;
    if (!is_said("--fill") && seams.divides() && charts == kAutomaticCharts && !no_pack &&
        !layout.has_own_sizes())
      fill = p.fill;
    if (!is_said("--padding")) padding = p.padding;
    if (!is_said("--resolution")) resolution = p.resolution;
    if (!uv_set && !bake) uv_set = p.uv_set;
  }
}

void UnwrapRequest::require_divisible() const {
  if (!hide_from.empty() && !seams.divides())
    throw Error(ErrorKind::Usage,
                fmt::format("--hide-from is of --seams auto and sharp; --seams {} says where to "
                            "cut; leave one of the two out",
                            seams.seams));
  const char* const flag = chart_count(charts) ? "--charts" : fill ? "--fill" : nullptr;
  if (flag && !seams.divides())
    throw Error(ErrorKind::Usage,
                fmt::format("{} divides charts of --seams auto and sharp; --seams {} says where to "
                            "cut; leave one of the two out",
                            flag, seams.seams));
  if (fill && charts == kOneChart)
    throw Error(ErrorKind::Usage,
                "--fill divides charts, --charts one leaves them; leave one of the two out");
  if (fill && chart_count(charts))
    throw Error(ErrorKind::Usage,
                fmt::format("--fill divides charts until they fill so much, --charts {} until "
                            "there are so many; leave one of the two out",
                            charts));
}

void UnwrapRequest::open(AtlasJob& job, PolygonMesh polygons, Strictness strictness) const {
  if (keep_seams && seams.seams == "uv")
    throw Error(ErrorKind::Usage,
                "--keep-seams: --seams uv cuts along them already; leave one of the two out");
  job.open(std::move(polygons), repairs());
  const Repair* const first = job.first_repair();
  if (first && strictness == Strictness::Everything)
    throw Error(ErrorKind::Unsupported,
                fmt::format("{}: {}; leave out --strict to have it repaired so", job.polygons->file,
                            describe(*first)));
  job.options.cuts = seams.options(*job.polygons, job.record.start_stop());
  if (keep_seams) job.old_seams = OldSeams::Cut;
  if (!hide_from.empty()) {
    const auto eye = direction_in(hide_from).value();
    job.hide_from = Vector3(eye[0], eye[1], eye[2]);
  }
  if (charts == kOneChart) job.options.limit = StretchLimit::Reported;
  job.options.least_charts = chart_count(charts).value_or(0);
  job.options.least_fill = fill;
  job.options.packing.reset();
  if (!no_pack)
    job.options.packing = PackOptions{.padding_pixels = padding, .resolution = resolution};
}

RepairOptions UnwrapRequest::repairs() const {
  RepairOptions options;
  const bool by_index = seams.seams == "uv" || !seams.file().empty();
  if (weld == kAutomaticWeld) options.welding = by_index ? Welding::Soups : Welding::EqualPlaces;
  if (weld == kNoWeld) options.welding = Welding::Nothing;
  options.weld = weld_distance(weld);
  return options;
}

std::optional<int> UnwrapRequest::image_side() const {
  if (preset.empty() && !is_said("--resolution")) return std::nullopt;
  return static_cast<int>(std::lround(std::max(resolution, 1.0)));
}

Json UnwrapRequest::to_json() const {
  Json options = seams.to_json();
  options.update({{"padding", padding},
                  {"resolution", resolution},
                  {"no_pack", no_pack},
                  {"scale", scale},
                  {"bake", bake},
                  {"uv_set", uv_set ? Json(*uv_set) : Json(nullptr)},
                  {"weld", weld_distance(weld) ? Json(*weld_distance(weld)) : Json(weld)},
                  {"keep_seams", keep_seams},
                  {"charts", chart_count(charts) ? Json(*chart_count(charts)) : Json(charts)},
                  {"fill", fill ? Json(*fill) : Json(nullptr)},
                  {"hide_from", hide_from.empty() ? Json(nullptr) : Json(hide_from)},
                  {"preset", preset.empty() ? Json(nullptr) : Json(preset)}});
  options.update(layout.to_json());
  return options;
}

void UnwrapVerb::add_to(CLI::App& verb) {
  map.add_to(verb, "1");
  outputs.extensions = map_extensions({".json"});
  outputs.add_to(verb);
  unwrap.add_to(verb);
  solve.add_limits_to(verb, map.curvature);
  add_linear_solver_to(verb, solve.linear_solver);
  common.add_to(verb);
}

std::vector<std::string> UnwrapVerb::baked_outputs() const {
  std::vector<std::string> models;
  if (!may_have_texture(map.input)) return models;
  const bool is_from_obj =
      find_format(format_of(map.input))->materials == Format::Materials::InFilesBeside;
  for (const std::string& path : outputs.files) {
    const bool is_obj = is_from_obj && has_material_files(path);
    if (!is_obj && !is_gltf(path)) continue;
    for (const std::string& other : models)
      if (is_gltf(other) == is_gltf(path))
        throw Error(
            ErrorKind::Usage,
            fmt::format("--bake moves the texture to one model of a kind, not to {} and {}; "
                        "leave one of the two out",
                        other, path));
    models.push_back(path);
  }
  return models;
}

std::vector<std::string> files_beside(const std::string& model) {
  if (!has_material_files(model)) return {};
  return {texture_file(model), material_file(model)};
}

namespace {

// Throws Error(Usage) for what --bake cannot do.
std::vector<std::string> baked_files(const UnwrapVerb& request) {
  if (!request.unwrap.bake) return {};
  const std::vector<std::string> models = request.baked_outputs();
  if (models.empty() && is_gltf(request.map.input))
    throw Error(ErrorKind::Usage,
                "--bake moves the texture of a GLB or glTF to one of these: -o OUT.glb");
  if (models.empty())
    throw Error(ErrorKind::Usage,
                "--bake moves the texture of an OBJ to an OBJ or a GLB, that of a GLB or glTF to "
                "one of these: -o OUT.obj, or -o OUT.glb");
  std::vector<std::string> files;
  for (const std::string& model : models) {
    const std::vector<std::string> beside = files_beside(model);
    if (is_standard_output(model) && !beside.empty())
      throw Error(
          ErrorKind::Usage,
          "--bake writes an image and materials beside the OBJ; give it a name: -o OUT.obj");
    files.insert(files.end(), beside.begin(), beside.end());
  }
  return files;
}

// Throws Error(Usage) where no output has a second set, or what is baked would be shown by it.
void require_uv_set(const UnwrapVerb& request) {
  const UnwrapRequest& unwrap = request.unwrap;
  if (!unwrap.uv_set) return;
  const std::vector<std::string>& files = request.outputs.files;
  if (std::none_of(files.begin(), files.end(), is_gltf))
    throw Error(ErrorKind::Usage,
                "--uv-set: sets of texture coordinates are of .glb and .gltf; add -o OUT.glb");
  if (*unwrap.uv_set > 0 && unwrap.bake)
    throw Error(
        ErrorKind::Usage,
        fmt::format("--bake makes a texture of the first set, --uv-set {} leaves that alone; "
                    "leave one of the two out",
                    *unwrap.uv_set));
}

// Targets of points are in units of the mesh.
void choose_scale(UnwrapVerb& request) {
  std::string& scale = request.unwrap.scale;
  const bool has_targets = !(request.map.pins.empty() && request.map.handles.empty());
  if (scale == "unit" && has_targets)
    throw Error(ErrorKind::Usage, "--scale unit moves pins and handles; leave one of the two out");
  if (scale == "model" && request.outputs.normalize)
    throw Error(ErrorKind::Usage,
                "--normalize is --scale unit, not --scale model; leave one of the two out");
  if (scale.empty()) scale = has_targets ? "model" : "unit";
  const std::string tiled = request.unwrap.layout.needs_unit_square();
  if (scale == "model" && !tiled.empty())
    throw Error(ErrorKind::Usage,
                fmt::format("{} says how large the layout is, as --scale model, --pins and "
                            "--handles do; leave one of the two out",
                            tiled));
}

// Refuses options that --keep-shape leaves without effect.
void require_islands(const UnwrapVerb& request) {
  if (!request.unwrap.layout.keep_shape) return;
  if (request.unwrap.seams.seams != "uv")
    throw Error(ErrorKind::Usage,
                "--keep-shape is of the islands of texture coordinates; add --seams uv");
  if (!request.map.pins.empty() || !request.map.handles.empty() || request.map.degree > 1)
    throw Error(ErrorKind::Usage,
                "--keep-shape maps nothing anew; leave out --pins, --handles and --degree");
  if (!request.unwrap.layout.density_file().empty())
    throw Error(
        ErrorKind::Usage,
        "--keep-shape leaves islands at one scale, --texel-density FILE does not; give it a "
        "number, or leave one of the two out");
}

// Straight pieces of curves, and formats that hold the image alone, do not keep what lies on each
// other.
void require_stackable(const UnwrapVerb& request) {
  if (request.unwrap.layout.stack == "no") return;
  if (!request.map.pins.empty() || !request.map.handles.empty())
    throw Error(ErrorKind::Usage,
                "--stack moves charts that --pins and --handles hold; leave one of "
                "the two out");
  if (request.map.degree > 1 || request.outputs.formats.tessellation.refine > 1)
    throw Error(ErrorKind::Usage,
                "--stack is of straight triangles as they are; leave out --degree "
                "and --refine");
  if (request.unwrap.bake)
    throw Error(ErrorKind::Usage,
                "--bake needs a place for every point, --stack shares places; leave one of the two "
                "out");
  if (request.unwrap.layout.keep_shape)
    throw Error(
        ErrorKind::Usage,
        "--keep-shape leaves islands as they are, --stack makes them equal; leave one of the "
        "two out");
  for (const std::string& path : request.outputs.files)
    if (const Format* format = written_format(path); format && format->has_image_of_map)
      throw Error(ErrorKind::Usage,
                  fmt::format("{}: gmsh's files hold one layer; leave it, or --stack, out", path));
}

std::vector<std::string> formats_of_objects() {
  std::vector<std::string> out;
  for (const Format& format : formats())
    if (format.has_objects) out.push_back(format.extension);
  return out;
}

// Every object is unwrapped as if it were alone: what is said of the vertices and faces of the
// file, or of one square, says nothing then.
void require_objects(const UnwrapVerb& request) {
  const LayoutRequest& layout = request.unwrap.layout;
  if (!layout.is_of_objects()) return;
  const auto refuse = [](std::string_view flag) {
    throw Error(ErrorKind::Usage,
                fmt::format("--objects separate gives every object the unit square, by itself: not "
                            "with {}; leave one of the two out",
                            flag));
  };
  if (request.map.degree > 1) refuse("--degree above 1");
  if (!request.map.pins.empty()) refuse("--pins");
  if (!request.map.handles.empty()) refuse("--handles");
  if (!request.map.weights.empty()) refuse("--weights");
  if (!request.unwrap.seams.file().empty()) refuse("a FILE of --seams");
  if (weld_distance(request.unwrap.weld)) refuse("a DISTANCE of --weld");
  if (request.unwrap.scale == "model") refuse("--scale model");
  if (request.unwrap.bake) refuse("--bake");
  if (layout.stack != "no") refuse("--stack");
  if (const std::string flag = layout.needs_unit_square(); !flag.empty()) refuse(flag);
  if (!request.outputs.distortion.empty()) refuse("--distortion");
  for (const std::string& path : request.outputs.files) {
    const Format* const format = written_format(path);
    if ((format == nullptr || !format->has_objects) && extension(path) != ".json")
      throw Error(ErrorKind::Usage,
                  fmt::format("{}: --objects separate is of formats that have objects, {}; leave "
                              "it, or the option, out",
                              path, majorant::in_words(formats_of_objects(), "and")));
    if (is_gltf(path) && !is_gltf(request.map.input))
      throw Error(ErrorKind::Usage,
                  fmt::format("{}: of an input that is no glTF it holds one mesh, which has no "
                              "objects; write an .obj or .vtu, or leave --objects out",
                              path));
  }
}

void require_layout(const UnwrapVerb& request) {
  const LayoutRequest& layout = request.unwrap.layout;
  require_objects(request);
  require_islands(request);
  if (request.unwrap.bake && layout.udim > 0)
    throw Error(ErrorKind::Usage,
                "--bake makes one image, --udim one for every tile; leave one of "
                "the two out");
  require_stackable(request);
  require_uv_set(request);
  if (request.unwrap.fill && layout.has_own_sizes())
    throw Error(ErrorKind::Usage,
                "--fill divides charts of one scale on one square: not with --udim, "
                "--texel-density and --stack; leave one of the two out");
  const std::vector<std::string>& files = request.outputs.files;
  if (layout.groups && std::none_of(files.begin(), files.end(), has_material_files))
    throw Error(ErrorKind::Usage, "--groups: groups are of .obj; add -o OUT.obj");
}

// The image of --bake is as large as --resolution says.
void require_image(const UnwrapRequest& unwrap) {
  if (unwrap.bake && unwrap.image_side().value_or(1) > kLargestImage)
    throw Error(ErrorKind::Usage,
                fmt::format("--resolution {:g}: the image of --bake would have more than {} pixels "
                            "along a side",
                            unwrap.resolution, kLargestImage));
}

// A border of that many pixels on either side leaves room for charts.
void require_room(const UnwrapRequest& unwrap) {
  if (!unwrap.no_pack && 2 * unwrap.padding >= unwrap.resolution)
    throw Error(ErrorKind::Usage,
                fmt::format("--padding {:g}: on both sides of the layout it takes all of the {:g} "
                            "pixels of --resolution; give less of the one or more of the other",
                            unwrap.padding, unwrap.resolution));
}

}  // namespace

void UnwrapVerb::require_usable() {
  UnwrapVerb& request = *this;
  require_gpl_parts("unwrap");
  if (request.unwrap.bake) request.outputs.normalize = true;  // what an image shows
  request.outputs.require_usable(request.map);
  if (request.outputs.turns_map())
    throw Error(
        ErrorKind::Usage,
        "--align: unwrap lays its charts side by side as they fit; leave it out, or ask for "
        ".svg and .png alone");
  if (request.solve.linear_solver != "auto" && request.solve.linear_solver != "direct")
    throw Error(ErrorKind::Usage,
                fmt::format("--linear-solver {}: unwrap solves charts side by side, each by the "
                            "program's own solver; leave it out",
                            request.solve.linear_solver));
  choose_scale(request);
  require_layout(request);
  if (request.map.degree == 0) request.map.degree = 1;
  if (request.unwrap.seams.seams.empty()) request.unwrap.seams.seams = "auto";
  request.unwrap.use_preset();
  require_room(request.unwrap);
  require_image(request.unwrap);
  request.unwrap.require_divisible();
}

std::vector<std::string> UnwrapVerb::inputs() const {
  return {map.input,
          map.pins,
          map.handles,
          map.weights,
          unwrap.seams.file(),
          unwrap.layout.density_file(),
          outputs.formats.image};
}

std::vector<OutputNames> UnwrapVerb::output_names() const {
  std::vector<OutputNames> names = outputs.names();
  names.insert(names.begin(), {baked_files(*this), {".png", ".mtl"}});
  return names;
}

Json UnwrapVerb::to_json() const {
  Json options = map.to_json();
  options.update(solve.to_json());
  options.update(unwrap.to_json());
  options["strict"] = common.strict;
  for (const char* other : {"boundary", "init", "seamless", "bijective", "no_flips",
                            "write_scaffold", "improve_mesh", "snapshots"})
    options.erase(other);
  return options;
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
