// majorant unwrap IN -o OUT...: any mesh to a layout of charts without overlaps.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/arguments/help_text.h"
#include "apps/arguments/number_check.h"
#include "apps/arguments/suggestion.h"
#include "apps/command.h"
#include "apps/energy_option.h"
#include "apps/layout_request.h"
#include "apps/linear_solvers.h"
#include "apps/map_request.h"
#include "apps/or_interrupted.h"
#include "apps/page_content.h"
#include "apps/parts.h"
#include "apps/process.h"
#include "apps/progress.h"
#include "apps/result_files.h"
#include "apps/seam_request.h"
#include "apps/solve_request.h"
#include "apps/streams.h"
#include "apps/within_memory.h"
#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
#include "majorant/io/input_file.h"
#include "majorant/io/io.h"
#include "majorant/io/read_mesh.h"
#include "majorant/results/atlas_job.h"
#include "majorant/results/global_verdict.h"
#include "majorant/results/model_texture.h"
#include "majorant/results/obj_layout.h"
#include "majorant/results/object_layouts.h"

namespace majorant::app {
namespace {

constexpr const char* kAutomaticWeld = "auto";
constexpr const char* kNoWeld = "no";
constexpr const char* kAutomaticCharts = "auto";
constexpr const char* kOneChart = "one";

// What --preset sets, where nothing else is said.
struct Preset {
  std::string_view name;
  std::optional<double> max_stretch;
  std::string_view charts;
  double fill, padding, resolution;
};
constexpr double kAnyFill = 0;
constexpr std::array<Preset, 4> kPresets{{{"paint", 1.01, kAutomaticCharts, kAnyFill, 8, 4096},
                                          {"lightmap", 1.03, kAutomaticCharts, 0.6, 2, 512},
                                          {"game", 1.01, kAutomaticCharts, 0.6, 4, 2048},
                                          {"single", std::nullopt, kOneChart, kAnyFill, 4, 1024}}};

std::vector<std::string> preset_names() {
  std::vector<std::string> names;
  for (const Preset& preset : kPresets) names.emplace_back(preset.name);
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

// "X,Y,Z"; none for other words and for no direction.
std::optional<Vector3> direction_of(const std::string& word) {
  const std::vector<std::string> parts = CLI::detail::split(word, ',');
  Vector3 direction;
  if (parts.size() != 3) return std::nullopt;
  for (std::size_t k = 0; k < 3; ++k)
    if (!CLI::detail::lexical_cast(parts[k], direction[static_cast<Index>(k)])) return std::nullopt;
  if (!direction.allFinite() || direction.isZero(0)) return std::nullopt;
  return direction;
}

std::string wrong_direction(const std::string& word) {
  if (direction_of(word)) return {};
  return fmt::format("'{}' is no direction; give that to the eye, not 0,0,0: 1,0.5,2", word);
}

std::string wrong_fill(const std::string& word) {
  double fill = 0;
  if (CLI::detail::lexical_cast(word, fill) && fill > 0 && fill < 1) return {};
  return fmt::format("'{}' is no part of a square, above 0 and below 1", word);
}

// The distance that the word is; none for the other words.
std::optional<double> weld_distance(const std::string& word) {
  double distance = 0;
  if (word == kAutomaticWeld || word == kNoWeld || !CLI::detail::lexical_cast(word, distance))
    return std::nullopt;
  return distance;
}

// The message about what is neither.
std::string wrong_weld(const std::string& word) {
  if (word == kAutomaticWeld || word == kNoWeld) return {};
  const std::optional<double> distance = weld_distance(word);
  if (distance && *distance >= 0 && std::isfinite(*distance)) return {};
  return fmt::format("'{}' is neither auto nor no nor a distance from 0 on", word);
}

// The options of a layout: how to repair, where to cut, how to pack.
struct UnwrapRequest {
  SeamRequest seams;
  std::string weld = kAutomaticWeld;
  bool keep_seams = false;
  std::string charts = kAutomaticCharts;
  double fill = kAnyFill;
  std::string preset;     // empty: none
  std::string hide_from;  // empty: all sides
  double padding = PackOptions().padding_pixels, resolution = PackOptions().resolution;
  bool no_pack = false;
  std::string scale;  // empty: as `map` allows
  bool bake = false;  // the texture of the model, too
  LayoutRequest layout;

  void add_to(CLI::App& verb);
  // Takes from the preset what was not said.
  void use_preset();
  // Throws Error(Usage) for what --seams leaves no room for.
  void require_divisible() const;
  // Opens the job with the file, and says where to cut and how to pack. Throws Error(Unsupported)
  // for what would be repaired, where everything must be whole, and as SeamRequest::options.
  void open(AtlasJob& job, PolygonMesh polygons, Strictness strictness) const;
  RepairOptions repairs() const;
  Json to_json() const;  // for reports and claims

 private:
  bool is_said(const char* option) const { return verb_->get_option(option)->count() > 0; }

  const CLI::App* verb_ = nullptr;
};

void UnwrapRequest::add_to(CLI::App& verb) {
  verb_ = &verb;
  seams.add_to(verb);
  begin_group(verb, OptionGroup::Charts);
  verb.add_option("--padding", padding,
                  fmt::format("pixels between charts, and around them, at least ({})", padding))
      ->check(non_negative_number());
  verb.add_option("--resolution", resolution,
                  fmt::format("pixels along the side of the layout ({})", resolution))
      ->check(positive_number());
  verb.add_option(
          "--scale", scale,
          "unit (default): the layout lies in the unit square; model (default with --pins or "
          "--handles): a unit of it is one of the mesh")
      ->check(one_of({"unit", "model"}));
  verb.add_flag("--no-pack", no_pack, "leave charts where they are, also on top of each other")
      ->excludes("--padding")
      ->excludes("--resolution");
  verb.add_flag("--bake", bake,
                "move the texture to the new layout, which is that of --normalize: of an OBJ "
                "(map_Kd) to OUT.png and OUT.mtl beside OUT.obj, of a GLB (base colours) into "
                "OUT.glb")
      ->excludes("--no-pack");
  verb.add_option(
          "--weld", weld,
          "what is one surface for the map: auto, what lies edge on edge at equal positions "
          "(of --seams uv and FILE only where no face shares a vertex); no, nothing; or "
          "vertices no farther apart than a DISTANCE")
      ->type_name("auto|no|DISTANCE")
      ->check(CLI::Validator(wrong_weld, ""));
  verb.add_option("--charts", charts,
                  "auto: as many as --max-stretch needs, long thin ones divided; one: what --seams "
                  "says, whatever it stretches; N: so many, where fewer would do (auto)")
      ->type_name("auto|one|N")
      ->check(CLI::Validator(wrong_charts, ""));
  verb.add_option("--fill", fill,
                  "divide charts until they fill this part of the square, below 1, if they can")
      ->check(CLI::Validator(wrong_fill, ""))
      ->excludes("--no-pack");
  verb.add_option("--hide-from", hide_from,
                  "auto, sharp: seams out of sight of who looks from this direction (of all sides)")
      ->type_name("X,Y,Z")
      ->check(CLI::Validator(wrong_direction, ""));
  verb.add_option("--preset", preset,
                  "defaults of --max-stretch, --charts, --fill, --padding and --resolution for: "
                  "paint, few seams; lightmap; game; single, a chart for each piece")
      ->check(one_of(preset_names()));
  verb.add_flag("--keep-seams", keep_seams,
                "cut along the seams of the file's texture coordinates, too");
  layout.add_to(verb);
}

void UnwrapRequest::use_preset() {
  for (const Preset& p : kPresets) {
    if (p.name != preset) continue;
    if (!seams.max_stretch && seams.divides()) seams.max_stretch = p.max_stretch;
    if (!is_said("--charts") && seams.divides()) charts = p.charts;
    if (!is_said("--fill") && seams.divides() && charts == kAutomaticCharts && !no_pack &&
        !layout.has_own_sizes())
      fill = p.fill;
    if (!is_said("--padding")) padding = p.padding;
    if (!is_said("--resolution")) resolution = p.resolution;
  }
}

void UnwrapRequest::require_divisible() const {
  if (!hide_from.empty() && !seams.divides())
    throw Error(ErrorKind::Usage,
                fmt::format("--hide-from is of --seams auto and sharp; --seams {} says where to "
                            "cut; leave one of the two out",
                            seams.seams));
  const char* const flag = chart_count(charts) ? "--charts" : fill > 0 ? "--fill" : nullptr;
  if (flag && !seams.divides())
    throw Error(ErrorKind::Usage,
                fmt::format("{} divides charts of --seams auto and sharp; --seams {} says where to "
                            "cut; leave one of the two out",
                            flag, seams.seams));
  if (fill > 0 && charts == kOneChart)
    throw Error(ErrorKind::Usage,
                "--fill divides charts, --charts one leaves them; leave one of the two out");
  if (fill > 0 && chart_count(charts))
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
  if (!hide_from.empty()) job.hide_from = direction_of(hide_from);
  if (charts == kOneChart) job.options.limit = StretchLimit::Reported;
  job.options.least_charts = chart_count(charts).value_or(0);
  job.options.least_fill = fill;
  job.options.packing.reset();
  if (!no_pack)
    job.options.packing = PackOptions{.padding_pixels = padding, .resolution = resolution};
}

RepairOptions UnwrapRequest::repairs() const {
  RepairOptions how;
  const bool by_index = seams.seams == "uv" || !seams.file().empty();
  if (weld == kAutomaticWeld) how.welding = by_index ? Welding::Soups : Welding::EqualPlaces;
  if (weld == kNoWeld) how.welding = Welding::Nothing;
  how.weld = weld_distance(weld);
  return how;
}

Json UnwrapRequest::to_json() const {
  Json options = seams.to_json();
  options.update({{"padding", padding},
                  {"resolution", resolution},
                  {"no_pack", no_pack},
                  {"scale", scale},
                  {"bake", bake},
                  {"weld", weld_distance(weld) ? Json(*weld_distance(weld)) : Json(weld)},
                  {"keep_seams", keep_seams},
                  {"charts", chart_count(charts) ? Json(*chart_count(charts)) : Json(charts)},
                  {"fill", fill > 0 ? Json(fill) : Json(nullptr)},
                  {"hide_from", hide_from.empty() ? Json(nullptr) : Json(hide_from)},
                  {"preset", preset.empty() ? Json(nullptr) : Json(preset)}});
  options.update(layout.to_json());
  return options;
}

struct UnwrapVerb {
  CommonOptions common;
  MapRequest map;
  OutputRequest outputs;
  SolveRequest solve;
  UnwrapRequest unwrap;
};

// The output that the texture moves to: of the kind of the input; null where there is none. Throws
// Error(Usage) for several.
const std::string* baked_output(const UnwrapVerb& request) {
  if (!may_have_texture(request.map.input)) return nullptr;
  const bool is_obj = format_of(request.map.input) == ".obj";
  const std::string* model = nullptr;
  for (const std::string& path : request.outputs.files) {
    if (is_obj ? extension(path) != ".obj" : !is_gltf(path)) continue;
    if (model != nullptr)
      throw Error(ErrorKind::Usage,
                  fmt::format("--bake moves the texture to one model, not to {} and {}; leave one "
                              "of the two out",
                              *model, path));
    model = &path;
  }
  return model;
}

// The files that --bake writes beside the model.
std::vector<std::string> files_beside(const std::string& model) {
  if (extension(model) != ".obj") return {};
  return {texture_file(model), material_file(model)};
}

// The same of a request. Throws Error(Usage) for what --bake cannot do.
std::vector<std::string> baked_files(const UnwrapVerb& request) {
  if (!request.unwrap.bake) return {};
  const std::string* const model = baked_output(request);
  if (model == nullptr)
    throw Error(ErrorKind::Usage,
                "--bake moves the texture of an OBJ to an OBJ, that of a GLB or glTF to one of "
                "these: -o OUT.obj, or -o OUT.glb");
  return files_beside(*model);
}

Json options_of(const UnwrapVerb& request) {
  Json options = request.map.to_json();
  options.update(request.solve.to_json());
  options.update(request.unwrap.to_json());
  options["strict"] = request.common.strict;
  for (const char* other : {"boundary", "init", "seamless", "bijective", "no_flips",
                            "write_scaffold", "improve_mesh", "snapshots"})
    options.erase(other);
  return options;
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

// What --keep-shape leaves without effect.
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
    if (extension(path) == ".msh")
      throw Error(ErrorKind::Usage,
                  fmt::format("{}: gmsh's files hold one layer; leave it, or --stack, out", path));
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
    if (extension(path) != ".obj" && !is_gltf(path) && extension(path) != ".vtu" &&
        extension(path) != ".json")
      throw Error(ErrorKind::Usage,
                  fmt::format("{}: --objects separate is of formats that have objects, .obj, .glb, "
                              ".gltf and .vtu; leave it, or the option, out",
                              path));
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
  if (request.unwrap.fill > 0 && layout.has_own_sizes())
    throw Error(ErrorKind::Usage,
                "--fill divides charts of one scale on one square: not with --udim, "
                "--texel-density and --stack; leave one of the two out");
  const std::vector<std::string>& files = request.outputs.files;
  if (layout.groups && std::none_of(files.begin(), files.end(), [](const std::string& path) {
        return extension(path) == ".obj";
      }))
    throw Error(ErrorKind::Usage, "--groups: groups are of .obj; add -o OUT.obj");
}

// A border of that many pixels on either side leaves room for charts.
void require_room(const UnwrapRequest& unwrap) {
  if (!unwrap.no_pack && 2 * unwrap.padding >= unwrap.resolution)
    throw Error(ErrorKind::Usage,
                fmt::format("--padding {:g}: on both sides of the layout it takes all of the {:g} "
                            "pixels of --resolution; give less of the one or more of the other",
                            unwrap.padding, unwrap.resolution));
}

void require_usable(UnwrapVerb& request, const StopCheck& stop) {
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
  request.unwrap.require_divisible();
  request.outputs.formats.read_image(stop);
  require_writable(request.common,
                   {{baked_files(request), {".png", ".mtl"}},
                    {request.outputs.files, request.outputs.extensions},
                    {{request.outputs.distortion}, {".csv"}}},
                   {request.map.input, request.map.pins, request.map.handles, request.map.weights,
                    request.unwrap.seams.file(), request.unwrap.layout.density_file(),
                    request.outputs.formats.image});
}

// A run of unwrap that has ended. Only refers: all must outlive it.
struct FinishedUnwrap {
  const CommonOptions& common;
  const OutputRequest& outputs;
  const MapRequest& map;
  const AtlasJob& job;
  std::chrono::steady_clock::time_point start;  // of the run
  Progress& progress;
  const std::optional<ModelTexture>& texture;  // to be baked
  const std::string* baked;                    // the output that it moves to, or null
  const LayoutRequest& layout;
};

// The mesh that an OBJ of this name is written with.
PolygonMesh marked_polygons(const FinishedUnwrap& run, const std::string& path,
                            const MapFile& file) {
  PolygonMesh mesh = *run.job.polygons;
  if (run.baked != nullptr && path == *run.baked) mesh = with_material_file(std::move(mesh), path);
  std::vector<int> chart = chart_of_polygons(file, mesh);
  if (run.layout.udim > 0) {
    std::vector<int> tile = chart;
    for (int& number : tile)
      if (number >= 0) number = run.job.atlas.packing->tiles[to_size(number)];
    mesh = with_tile_materials(std::move(mesh), tile);
  }
  return run.layout.groups ? with_chart_groups(std::move(mesh), chart) : mesh;
}

// What an OBJ does not hold of the input since tiles have materials of their own.
std::vector<std::string> replaced(const FinishedUnwrap& run) {
  const std::vector<std::string> materials = material_of_polygons(*run.job.polygons);
  const bool has_some = std::any_of(materials.begin(), materials.end(),
                                    [](const std::string& name) { return !name.empty(); });
  if (run.layout.udim == 0 || !has_some) return {};
  return {"materials, since every tile has one"};
}

// Points with targets keep their charts where they put them.
MapPage page_of(const FinishedUnwrap& run) {
  MapPage page;
  page.title = page_title(run.map.input);
  page.facts = page_facts(atlas_report(run.job), run.map.inputs());
  page.points = pulled_points(run.job.options.chart.map.handles, *run.job.surface.mesh);
  for (const Chart& chart : run.job.atlas.charts)
    for (const Pin& pin : chart.pins)
      page.points.push_back({chart.map->mesh().input_vertex(pin.vertex),
                             chart.map->control_points().segment<2>(2 * pin.vertex),
                             PagePoint::Hold::Pin});
  return page;
}

void write_maps(const FinishedUnwrap& run, WrittenFiles& written) {
  FaceDistortion table;
  const MapFile file = atlas_file(run.job, &table);
  if (const std::string& path = run.outputs.distortion; !path.empty())
    written.write(path, [&] { write_distortion(path, file, table); });
  FormatOptions formats = run.outputs.formats;
  if (has_page(run.outputs.files)) formats.page = page_of(run);
  if (run.job.atlas.packing) formats.tessellation.overlap = Overlap::Excluded;
  for (const std::string& path : run.outputs.files)
    if (extension(path) != ".json")
      written.write(path, [&] {
        const bool is_obj = extension(path) == ".obj";
        const bool is_baked = run.baked != nullptr && path == *run.baked;
        const bool is_marked = is_obj && (is_baked || run.layout.udim > 0 || run.layout.groups);
        PolygonMesh marked;
        if (is_marked) marked = marked_polygons(run, path, file);
        const FileVerification verify = proof_of_file(path, promise(run.job, path), file, formats);
        const PolygonMesh& polygons = is_marked ? marked : *run.job.polygons;
        if (is_baked)
          or_interrupted("baking the texture of " + path, [&] {
            write_textured(path, {file, polygons, formats, verify}, *run.job.polygons, *run.texture,
                           run.job.record.stop());
          });
        else
          write_map(path, file, &polygons, formats, verify);
        if (run.common.quiet) return;
        std::vector<std::string> left = left_out(path, file, formats, run.job.polygons.get());
        if (is_obj)
          for (std::string& what : replaced(run)) left.push_back(std::move(what));
        say_left_out(path, left);
      });
  if (run.baked != nullptr && written.has(*run.baked))
    for (const std::string& path : files_beside(*run.baked)) written.add(path);
}

void write_reports(const FinishedUnwrap& run, double write_seconds, WrittenFiles& written) {
  std::vector<std::string> paths;
  if (!run.common.report.empty()) paths.push_back(run.common.report);
  for (const std::string& path : run.outputs.files)
    if (extension(path) == ".json") paths.push_back(path);
  if (paths.empty()) return;
  Json report = atlas_report(run.job);
  for (const std::string& path : paths) {
    report["outputs"] = written.to_json();
    report["seconds"]["write"] = write_seconds;
    report["seconds"]["total"] = seconds_since(run.start);
    written.write(path, [&] { write_json(path, report); });
  }
}

std::string chart_name(const AtlasJob& job, std::size_t k) {
  const Chart& chart = job.atlas.charts[k];
  return fmt::format("{}: chart {} (face {} and {} more)", job.polygons->file, k + 1,
                     job.surface.mesh->input_face(chart.faces.front()) + 1, chart.faces.size() - 1);
}

// Charts that did not converge, by their first faces, and those that stretch more than they may.
std::vector<std::string> lines_of_charts(const AtlasJob& job) {
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < job.atlas.charts.size(); ++k) {
    const Chart& chart = job.atlas.charts[k];
    if (chart.status != Status::Converged)
      lines.push_back(fmt::format("majorant: {}: {}{}\n", chart_name(job, k),
                                  status_name(chart.status),
                                  chart.message.empty() ? "" : ": " + chart.message));
    if (const std::string why = why_stretched(job.options, chart); !why.empty())
      lines.push_back(
          fmt::format("majorant: {}: stretch {:.4f}, more than --max-stretch {:g}: {}\n",
                      chart_name(job, k), chart.stretch.l2, job.options.cuts.max_stretch, why));
  }
  return lines;
}

// Why charts were not divided further; `nothing` where that would have helped nothing.
std::string_view why_undivided(Status division, std::string_view nothing) {
  switch (division) {
    case Status::TimeLimit:
      return "the time limit was reached";
    case Status::Interrupted:
      return "interrupted";
    case Status::MaxIterations:
      return "no more layouts are tried";
    default:
      return nothing;
  }
}

// What was repaired, and what was asked of the layout and could not be had.
std::vector<std::string> remarks(const AtlasJob& job) {
  std::vector<std::string> lines;
  const std::string& input = job.polygons->file;
  for (const Repair& r : job.surface.repairs)
    lines.push_back(fmt::format("{}: {}\n", input, describe(r)));
  const Atlas& atlas = job.atlas;
  const UnwrapOptions& asked = job.options;
  const auto count = static_cast<Index>(atlas.charts.size());
  if (asked.least_charts > 0 && count != asked.least_charts)
    lines.push_back(fmt::format(
        "{}: {} charts, not --charts {}: {}\n", input, count, asked.least_charts,
        count > asked.least_charts ? "fewer would stretch more than --max-stretch, or join pieces"
                                   : why_undivided(atlas.division, "none can be divided further")));
  if (asked.least_fill > 0 && atlas.packing && atlas.packing->fill < asked.least_fill)
    lines.push_back(fmt::format("{}: fill {:.3f}, not --fill {:g}: {}\n", input,
                                atlas.packing->fill, asked.least_fill,
                                why_undivided(atlas.division, "dividing charts gains no more")));
  return lines;
}

void say_all(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) say("{}", line);
}

void summarize(const FinishedUnwrap& run, const WrittenFiles& written) {
  const Atlas& atlas = run.job.atlas;
  say_all(lines_of_charts(run.job));
  if (run.common.quiet || atlas.status() == Status::Failed) return;
  say_all(remarks(run.job));
  say_untextured(run.map.input, atlas.cuts);
  written.say_sizes();
  const std::string fill = atlas.packing ? fmt::format(", fill {:.2f}", atlas.packing->fill) : "";
  const auto stacked = std::count_if(atlas.charts.begin(), atlas.charts.end(),
                                     [](const Chart& chart) { return chart.place.has_value(); });
  const std::string on_others = stacked > 0 ? fmt::format(" ({} on others)", stacked) : "";
  say("{}: {}, {} chart{}{}, {} {:.6f}, seams {:.4g} ({:.3g} sqrt(area)), stretch {:.4f}{}, "
      "degree {}, {}, {:.2f} s\n",
      run.map.input, status_name(atlas.status()), atlas.charts.size(),
      atlas.charts.size() == 1 ? "" : "s", on_others, run.map.energy, atlas.value(),
      seam_length(run.job), seam_length(run.job) / std::sqrt(run.job.surface.mesh->area()),
      atlas.stretch().l2, fill, run.map.degree, overlap_words(run.job.boundary, ImageOf::Charts),
      seconds_since(run.start));
  const bool is_stacked = run.job.options.stacking != Stacking::None;
  for (const std::string& path : run.outputs.files)
    if (is_map_data(path) && written.has(path))
      say("proof: majorant check {}{}{}\n", path, atlas.packing ? " --certify" : "",
          is_stacked && format_of(path) != ".vtu" ? " --stacked" : "");
}

// Writes the layout, unless a chart failed, each file certified, then the reports, then the lines
// on stderr; returns the exit code.
int write_atlas(const FinishedUnwrap& run) {
  const double before = seconds_since(run.start);
  WrittenFiles written;
  run.job.record.begin(Activity::Writing);
  if (run.job.atlas.status() != Status::Failed) write_maps(run, written);
  write_reports(run, seconds_since(run.start) - before, written);
  run.progress.finish();
  summarize(run, written);
  return written.conclude(exit_code(run.job.atlas.status()));
}

// The charts of a mesh, in place and proven.
void unwrap_mesh(const UnwrapVerb& request, PolygonMesh polygons, Strictness strictness,
                 LinearSolvers& solvers, AtlasJob& job) {
  const RunRecord& record = job.record;
  job.energy = request.map.energy;
  or_interrupted("reading " + request.map.input, [&] {
    request.unwrap.open(job, std::move(polygons), strictness);
    job.options.chart = read_options(request.map, *job.polygons, *job.surface.mesh,
                                     record.start_stop(), job.surface.welded);
    request.unwrap.layout.apply(job, record.start_stop());
  });
  request.solve.apply(job.options.chart);
  job.options.cutting_seconds = kCuttingShare * request.solve.time_limit;
  solvers.apply(job.options.chart.solve);
  job.read_seconds = record.seconds();
  or_interrupted("unwrapping " + request.map.input, [&] { job.solve(); });
  if (request.unwrap.scale == "unit" && !job.place())
    throw Error(ErrorKind::Invalid,
                request.map.input +
                    ": in the unit square its smallest triangles are too small for doubles; " +
                    (request.unwrap.layout.needs_unit_square().empty()
                         ? "add --scale model"
                         : "leave out " + request.unwrap.layout.needs_unit_square() +
                               " and add --scale model"));
  job.asked = options_of(request);
  job.linear_solver = solvers.section();
  job.memory = solvers.memory();
  job.prove();
}

// The objects of a file, each unwrapped by itself.
class ObjectsRun {
 public:
  ObjectsRun(const UnwrapVerb& request, PolygonMesh polygons, Strictness strictness,
             LinearSolvers& solvers, RunRecord& record)
      : request_(request),
        polygons_(std::move(polygons)),
        strictness_(strictness),
        solvers_(solvers),
        record_(record) {}

  void solve() {
    objects_ = unwrap_objects(polygons_, record_, [&](PolygonMesh object, AtlasJob& job) {
      const std::string file = object.file;
      unwrap_mesh(request_, std::move(object), strictness_, solvers_, job);
      append(lines_of_charts_, lines_of_charts(job));
      const Status status = job.atlas.status();
      if (status == Status::Failed) return;  // there is no layout to sum up
      append(lines_, remarks(job));
      lines_.push_back(fmt::format(
          "{}: {}, {}, {} {:.6f}, stretch {:.4f}, fill {:.2f}, {}\n", file, status_name(status),
          count_text(static_cast<Index>(job.atlas.charts.size()), "chart"), request_.map.energy,
          job.atlas.value(), job.atlas.stretch().l2, job.atlas.packing->fill,
          overlap_words(job.boundary, ImageOf::Charts)));
    });
  }

  // Returns the exit code.
  int write(std::chrono::steady_clock::time_point start, Progress& progress) {
    const double before = seconds_since(start);
    WrittenFiles written;
    record_.begin(Activity::Writing);
    if (objects_.status != Status::Failed) write_maps(written);
    write_reports(before, start, written);
    progress.finish();
    say_all(lines_of_charts_);
    if (!request_.common.quiet && objects_.status != Status::Failed) {
      written.say_sizes();
      say_all(lines_);
      for (const std::string& path : request_.outputs.files)
        if (is_map_data(path) && written.has(path))
          say("proof: majorant check {} --certify --objects separate\n", path);
    }
    return written.conclude(exit_code(objects_.status));
  }

 private:
  static void append(std::vector<std::string>& lines, const std::vector<std::string>& more) {
    lines.insert(lines.end(), more.begin(), more.end());
  }

  // The mesh as an .obj has it.
  PolygonMesh with_lines(const MapFile& file) const {
    PolygonMesh mesh = polygons_;
    if (mesh.gltf) mesh = with_object_names(std::move(mesh), objects_of(polygons_));
    if (request_.unwrap.layout.groups)
      mesh = with_chart_groups(std::move(mesh), chart_of_polygons(file, polygons_));
    return mesh;
  }

  void write_maps(WrittenFiles& written) {
    const MapFile file = map_of_objects(std::move(objects_.layouts));
    const bool has_lines = request_.unwrap.layout.groups || polygons_.gltf;
    const PolygonMesh lines = has_lines ? with_lines(file) : PolygonMesh();
    for (const std::string& path : request_.outputs.files) {
      if (extension(path) == ".json") continue;
      written.write(path, [&] {
        const bool is_marked = has_lines && extension(path) == ".obj";
        write_map(path, file, is_marked ? &lines : &polygons_, request_.outputs.formats,
                  proof_of_objects(path, polygons_));
        if (!request_.common.quiet)
          say_left_out(path, left_out(path, file, request_.outputs.formats, &polygons_));
      });
    }
  }

  void write_reports(double before, std::chrono::steady_clock::time_point start,
                     WrittenFiles& written) {
    std::vector<std::string> paths;
    if (!request_.common.report.empty()) paths.push_back(request_.common.report);
    for (const std::string& path : request_.outputs.files)
      if (extension(path) == ".json") paths.push_back(path);
    for (const std::string& path : paths) {
      const Json report{
          {"schema_version", 1},
          {"version", MAJORANT_VERSION},
          {"command", "unwrap"},
          {"status", status_name(objects_.status)},
          {"message", objects_.message},
          {"warnings", polygons_.warnings},
          {"options", objects_.asked},
          {"objects", objects_.sections},
          {"outputs", written.to_json()},
          {"seconds", {{"write", seconds_since(start) - before}, {"total", seconds_since(start)}}}};
      written.write(path, [&] { write_json(path, report); });
    }
  }

  const UnwrapVerb& request_;
  const PolygonMesh polygons_;
  const Strictness strictness_;
  LinearSolvers& solvers_;
  RunRecord& record_;
  UnwrappedObjects objects_;
  std::vector<std::string> lines_of_charts_, lines_;  // those that sum up, by object
};

int unwrap_file(UnwrapVerb request) {
  const auto start = std::chrono::steady_clock::now();
  Progress progress(request.common, {Activity::Reading, Activity::Cutting, Activity::Solving,
                                     Activity::Packing, Activity::Proving, Activity::Writing});
  RunRecord record = request.solve.make_record(progress);
  require_usable(request, record.start_stop());
  const ThreadCount threads(usable_threads(request.common.threads));
  const Strictness strictness = request.common.strictness(
      request.unwrap.keep_seams ? Strictness::Texcoords : request.unwrap.seams.needed_of_file());
  std::optional<ModelTexture> texture;
  record.begin(Activity::Reading);
  PolygonMesh polygons = or_interrupted("reading " + request.map.input, [&] {
    PolygonMesh mesh = within_memory(request.map.input, [&] {
      return read_mesh(request.map.input, record.start_stop(), strictness);
    });
    say_warnings(mesh.warnings);
    request.outputs.require_materials(mesh);
    if (request.unwrap.bake) {
      texture =
          within_memory(request.map.input, [&] { return read_texture(mesh, record.start_stop()); });
      say_warnings(texture->warnings);
    }
    return mesh;
  });
  LinearSolvers solvers(request.solve.linear_solver, request.common, LinearSolvers::Runs::Several);
  if (request.unwrap.layout.is_of_objects()) {
    ObjectsRun run(request, std::move(polygons), strictness, solvers, record);
    run.solve();
    return run.write(start, progress);
  }
  AtlasJob job(record);
  unwrap_mesh(request, std::move(polygons), strictness, solvers, job);
  return write_atlas({request.common, request.outputs, request.map, job, start, progress, texture,
                      texture ? baked_output(request) : nullptr, request.unwrap.layout});
}

}  // namespace

void add_unwrap(CLI::App& app, Action* run) {
  auto request = std::make_shared<UnwrapVerb>();
  CLI::App& verb = *app.add_subcommand(
      "unwrap", "cut any mesh into charts and lay them side by side, without overlaps");
  request->map.add_to(verb, "1");
  request->outputs.extensions = map_extensions({".json"});
  request->outputs.add_to(verb);
  request->unwrap.add_to(verb);
  request->solve.add_limits_to(verb, request->map.curvature);
  add_linear_solver_to(verb, request->solve.linear_solver);
  request->common.add_to(verb);
  verb.footer(
      energy_help() +
      "Example: majorant unwrap bunny.obj -o unwrapped.obj --padding 8 --report bunny.json");
  verb.callback([request, run] { *run = [request] { return unwrap_file(*request); }; });
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
