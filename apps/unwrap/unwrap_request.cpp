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

// Returns the number of charts that the word names; none for other words.
std::optional<Index> chart_count(const std::string& word) {
  Index count = 0;
  if (word == kAutomaticCharts || word == kOneChart || !CLI::detail::lexical_cast(word, count))
    return std::nullopt;
  return count;
}

// Returns the message about a word that is not a valid number of charts.
std::string wrong_charts(const std::string& word) {
  if (word == kAutomaticCharts || word == kOneChart || chart_count(word).value_or(0) > 0) return {};
  return fmt::format("'{}' is not auto, one, or a whole number of at least 1", word);
}

std::string wrong_direction(const std::string& word) {
  if (direction_in(word)) return {};
  return fmt::format(
      "'{}' is not a direction; give three numbers towards the viewer, not all 0: 1,0.5,2", word);
}

std::string wrong_fill(const std::string& word) {
  const double fill = number_in(word).value_or(1);
  if (fill >= 0 && fill < 1) return {};
  return fmt::format(
      "'{}' is not a fraction of the square; give a number of at least 0 and below 1", word);
}

// Returns the distance that the word names; none for other words.
std::optional<double> weld_distance(const std::string& word) {
  if (word == kAutomaticWeld || word == kNoWeld) return std::nullopt;
  return number_in(word);
}

// Returns the message about a word that is not a valid welding.
std::string wrong_weld(const std::string& word) {
  if (word == kAutomaticWeld || word == kNoWeld) return {};
  const std::optional<double> distance = weld_distance(word);
  if (distance && *distance >= 0 && std::isfinite(*distance)) return {};
  return fmt::format("'{}' is not auto, no, or a distance of at least 0", word);
}

}  // namespace

void UnwrapRequest::add_to(CLI::App& verb) {
  verb_ = &verb;
  seams.add_to(verb);
  add_options(
      verb, OptionGroup::Charts,
      {{"--padding",
        &padding,
        fmt::format("least gap between charts and around them, in pixels ({})", padding),
        {.check = non_negative_number()}},
       {"--resolution",
        &resolution,
        fmt::format("side of the layout, in pixels ({})", resolution),
        {.check = positive_number()}},
       {"--scale",
        &scale,
        "unit: the layout fits into the unit square (default); model: lengths are those of the "
        "mesh (default with --pins or --handles)",
        {.check = one_of({"unit", "model"})}},
       {"--no-pack",
        &no_pack,
        "leave charts where they are, even on top of each other",
        {.excludes = {"--padding", "--resolution"}}},
       {"--bake",
        &bake,
        "move the texture to the new layout, which is placed as by --normalize. OBJ input (map_Kd "
        "and other maps): to OUT.png and OUT.mtl beside OUT.obj, or into OUT.glb. GLB input (base "
        "colours): into OUT.glb. The image is as large as --resolution says, or as the input "
        "images together",
        {.excludes = {"--no-pack"}}},
       {"--uv-set",
        &uv_set,
        "glTF: the texture coordinate set that holds the new layout: 0 (the old set moves to the "
        "next one if materials use it) or 1 (set 0 stays as it is) (0; lightmap: 1)",
        {.type = "0|1", .check = CLI::IsMember({0, 1})}},
       {"--weld",
        &weld,
        "which vertices are joined before cutting: auto: edges at equal positions (with --seams uv "
        "or FILE only if no face shares a vertex); no: none; DISTANCE: vertices at most this far "
        "apart",
        {.type = "auto|no|DISTANCE", .check = checked_by(wrong_weld)}},
       {"--charts",
        &charts,
        "number of charts: auto: as many as --max-stretch needs, long thin ones divided; one: what "
        "--seams cuts, whatever its stretch; N: at least N (auto)",
        {.type = "auto|one|N", .check = checked_by(wrong_charts)}},
       {"--fill",
        &fill,
        fmt::format("divide charts until they fill this part of the square, below 1, if they can; "
                    "0: never divide for this (default: up to {:g} where that takes little seam)",
                    kUsualFill),
        {.check = checked_by(wrong_fill), .excludes = {"--no-pack"}}},
       {"--hide-from",
        &hide_from,
        "auto, sharp: hide seams from a viewer in this direction (default: from viewers on all "
        "sides)",
        {.type = "X,Y,Z", .check = checked_by(wrong_direction)}},
       {"--preset",
        &preset,
        "defaults of --max-stretch, --charts, --fill, --padding and --resolution for a use: paint "
        "(few seams), lightmap, game, single (a chart for each piece)",
        {.check = one_of(preset_names())}},
       {"--keep-seams", &keep_seams,
        "also cut along the seams of the file's texture coordinates"}});
  layout.add_to(verb);
}

void UnwrapRequest::use_preset() {
  for (const LayoutPreset& p : kLayoutPresets) {
    if (p.name != preset) continue;
    if (!seams.max_stretch && seams.divides()) seams.max_stretch = p.max_stretch;
    if (!is_given("--charts") && seams.divides())
      charts = p.is_one_chart ? kOneChart : kAutomaticCharts;
    if (!is_given("--fill") && seams.divides() && charts == kAutomaticCharts && !no_pack &&
        !layout.has_own_sizes())
      fill = p.fill;
    if (!is_given("--padding")) padding = p.padding;
    if (!is_given("--resolution")) resolution = p.resolution;
    if (!uv_set && !bake) uv_set = p.uv_set;
  }
}

void UnwrapRequest::require_divisible() const {
  if (!hide_from.empty() && !seams.divides())
    throw Error(ErrorKind::Usage,
                fmt::format("--hide-from applies to --seams auto and sharp; --seams {} says where "
                            "to cut; leave one of the two out",
                            seams.seams));
  const char* const flag = chart_count(charts) ? "--charts" : fill ? "--fill" : nullptr;
  if (flag && !seams.divides())
    throw Error(ErrorKind::Usage,
                fmt::format("{} divides charts made by --seams auto and sharp; --seams {} says "
                            "where to cut; leave one of the two out",
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
    throw Error(
        ErrorKind::Usage,
        "--keep-seams has no effect: --seams uv cuts along them already; leave one of the two out");
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
  if (preset.empty() && !is_given("--resolution")) return std::nullopt;
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
        throw Error(ErrorKind::Usage,
                    fmt::format("--bake moves the texture to one OBJ and one glTF model at most, "
                                "not to both {} and {}; leave one of the two out",
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

// Returns the files that --bake writes beside models. Throws Error(Usage) if it cannot bake.
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

// Throws Error(Usage) if no output has a second set, or if a baked texture needs set 0.
void require_uv_set(const UnwrapVerb& request) {
  const UnwrapRequest& unwrap = request.unwrap;
  if (!unwrap.uv_set) return;
  const std::vector<std::string>& files = request.outputs.files;
  if (std::none_of(files.begin(), files.end(), is_gltf))
    throw Error(ErrorKind::Usage,
                "--uv-set: only .glb and .gltf have sets of texture coordinates; add -o OUT.glb");
  if (*unwrap.uv_set > 0 && unwrap.bake)
    throw Error(ErrorKind::Usage, fmt::format("--bake makes a texture for set 0, which --uv-set {} "
                                              "leaves as it is; leave one of the two out",
                                              *unwrap.uv_set));
}

// Chooses the scale. Targets of points are in units of the mesh.
void choose_scale(UnwrapVerb& request) {
  std::string& scale = request.unwrap.scale;
  const bool has_targets = !(request.map.pins.empty() && request.map.handles.empty());
  if (scale == "unit" && has_targets)
    throw Error(ErrorKind::Usage, "--scale unit moves pins and handles; leave one of the two out");
  if (scale == "model" && request.outputs.normalize)
    throw Error(ErrorKind::Usage,
                "--normalize means --scale unit, not --scale model; leave one of the two out");
  if (scale.empty()) scale = has_targets ? "model" : "unit";
  const std::string tiled = request.unwrap.layout.needs_unit_square();
  if (scale == "model" && !tiled.empty())
    throw Error(ErrorKind::Usage,
                fmt::format("{} sets the size of the layout, and so do --scale model, --pins and "
                            "--handles; leave one of the two out",
                            tiled));
}

// Refuses options that have no effect with --keep-shape.
void require_islands(const UnwrapVerb& request) {
  if (!request.unwrap.layout.keep_shape) return;
  if (request.unwrap.seams.seams != "uv")
    throw Error(ErrorKind::Usage,
                "--keep-shape applies to the islands of texture coordinates; add --seams uv");
  if (!request.map.pins.empty() || !request.map.handles.empty() || request.map.degree > 1)
    throw Error(ErrorKind::Usage,
                "--keep-shape computes no new map; leave out --pins, --handles and --degree");
  if (!request.unwrap.layout.density_file().empty())
    throw Error(
        ErrorKind::Usage,
        "--keep-shape leaves islands at one scale, --texel-density FILE does not; give it a "
        "number, or leave one of the two out");
}

// Refuses outputs that do not keep charts on one place: straight pieces of curves, and formats that
// hold only the image.
void require_stackable(const UnwrapVerb& request) {
  if (request.unwrap.layout.stack == "no") return;
  if (!request.map.pins.empty() || !request.map.handles.empty())
    throw Error(ErrorKind::Usage,
                "--stack moves charts that --pins and --handles hold; leave one of "
                "the two out");
  if (request.map.degree > 1 || request.outputs.formats.tessellation.refine > 1)
    throw Error(ErrorKind::Usage,
                "--stack needs straight triangles that are not subdivided; leave out --degree and "
                "--refine");
  if (request.unwrap.bake)
    throw Error(ErrorKind::Usage,
                "--bake needs a separate place for every point, but --stack shares places; leave "
                "one of the two out");
  if (request.unwrap.layout.keep_shape)
    throw Error(
        ErrorKind::Usage,
        "--keep-shape leaves islands as they are, --stack makes them equal; leave one of the "
        "two out");
  for (const std::string& path : request.outputs.files)
    if (const Format* format = written_format(path); format && format->has_image_of_map)
      throw Error(
          ErrorKind::Usage,
          fmt::format("{}: gmsh files hold one layer; leave out this output or --stack", path));
}

std::vector<std::string> formats_of_objects() {
  std::vector<std::string> out;
  for (const Format& format : formats())
    if (format.has_objects) out.push_back(format.extension);
  return out;
}

// Refuses options about vertices and faces of the file or about one square: with --objects separate
// each object is unwrapped by itself.
void require_objects(const UnwrapVerb& request) {
  const LayoutRequest& layout = request.unwrap.layout;
  if (!layout.is_of_objects()) return;
  const auto refuse = [](std::string_view flag) {
    throw Error(ErrorKind::Usage,
                fmt::format("--objects separate gives each object a unit square of its own, and "
                            "cannot be combined with {}; leave one of the two out",
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
                  fmt::format("{}: --objects separate needs a format that has objects, {}; leave "
                              "out this file or the option",
                              path, majorant::in_words(formats_of_objects(), "and")));
    if (is_gltf(path) && !is_gltf(request.map.input))
      throw Error(ErrorKind::Usage,
                  fmt::format("{}: holds one mesh without objects, since the input is not glTF; "
                              "write an .obj or .vtu, or leave out --objects",
                              path));
  }
}

void require_layout(const UnwrapVerb& request) {
  const LayoutRequest& layout = request.unwrap.layout;
  require_objects(request);
  require_islands(request);
  if (request.unwrap.bake && layout.udim > 0)
    throw Error(
        ErrorKind::Usage,
        "--bake makes one image, but --udim needs one for every tile; leave one of the two out");
  require_stackable(request);
  require_uv_set(request);
  if (request.unwrap.fill && layout.has_own_sizes())
    throw Error(ErrorKind::Usage,
                "--fill needs one square and one scale, and cannot be combined with --udim, "
                "--texel-density or --stack; leave one of the two out");
  const std::vector<std::string>& files = request.outputs.files;
  if (layout.groups && std::none_of(files.begin(), files.end(), has_material_files))
    throw Error(ErrorKind::Usage, "--groups: only .obj has groups; add -o OUT.obj");
}

// Checks that the image of --bake, whose side is --resolution, is not too large.
void require_image(const UnwrapRequest& unwrap) {
  if (unwrap.bake && unwrap.image_side().value_or(1) > kLargestImage)
    throw Error(ErrorKind::Usage,
                fmt::format("--resolution {:g}: the image of --bake would have more than {} pixels "
                            "along a side",
                            unwrap.resolution, kLargestImage));
}

// Checks that the padding on both sides leaves room for charts.
void require_room(const UnwrapRequest& unwrap) {
  if (!unwrap.no_pack && 2 * unwrap.padding >= unwrap.resolution)
    throw Error(ErrorKind::Usage,
                fmt::format("--padding {:g}: twice this leaves nothing of the {:g} pixels of "
                            "--resolution; lower the one or raise the other",
                            unwrap.padding, unwrap.resolution));
}

}  // namespace

void UnwrapVerb::require_usable() {
  UnwrapVerb& request = *this;
  if (request.unwrap.bake) request.outputs.normalize = true;  // images show the unit square
  request.outputs.require_usable(request.map);
  if (request.outputs.turns_map())
    throw Error(
        ErrorKind::Usage,
        "--align: unwrap packs its charts as they fit; leave it out, or write .svg and .png alone");
  if (request.solve.linear_solver != "auto" && request.solve.linear_solver != "direct")
    throw Error(ErrorKind::Usage, fmt::format("--linear-solver {}: unwrap solves several charts at "
                                              "a time, each with the built-in solver; leave it out",
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
                            "write_scaffold", "improve_mesh", "snapshots", "effort"})
    options.erase(other);
  return options;
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
