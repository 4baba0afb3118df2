// majorant unwrap IN -o OUT...: any mesh to a layout of charts without overlaps.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

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
#include "majorant/results/obj_layout.h"
#include "majorant/results/obj_texture.h"

namespace majorant::app {
namespace {

constexpr const char* kAutomaticWeld = "auto";
constexpr const char* kNoWeld = "no";
constexpr const char* kAutomaticCharts = "auto";
constexpr const char* kOneChart = "one";

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
  double padding = PackOptions().padding_pixels, resolution = PackOptions().resolution;
  bool no_pack = false;
  std::string scale;  // empty: as `map` allows
  bool bake = false;  // the texture of an OBJ, too
  LayoutRequest layout;

  void add_to(CLI::App& verb);
  // Opens the job with the file, and says where to cut and how to pack. Throws Error(Unsupported)
  // for what would be repaired, where everything must be whole, and as SeamRequest::options.
  void open(AtlasJob& job, PolygonMesh polygons, Strictness strictness) const;
  RepairOptions repairs() const;
  Json to_json() const;  // for reports and claims
};

void UnwrapRequest::add_to(CLI::App& verb) {
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
                "move the texture of an OBJ (map_Kd) to the new layout: OUT.png and OUT.mtl beside "
                "OUT.obj; the layout is that of --normalize")
      ->excludes("--no-pack");
  verb.add_option(
          "--weld", weld,
          "what is one surface for the map: auto, what lies edge on edge at equal positions "
          "(of --seams uv and FILE only where no face shares a vertex); no, nothing; or "
          "vertices no farther apart than a DISTANCE")
      ->type_name("auto|no|DISTANCE")
      ->check(CLI::Validator(wrong_weld, ""));
  verb.add_option("--charts", charts,
                  "auto: as many as --max-stretch needs; one: what --seams says, whatever it "
                  "stretches (auto)")
      ->check(CLI::IsMember({kAutomaticCharts, kOneChart}));
  verb.add_flag("--keep-seams", keep_seams,
                "cut along the seams of the file's texture coordinates, too");
  layout.add_to(verb);
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
  job.options.cuts = seams.options(*job.polygons);
  if (keep_seams) job.old_seams = OldSeams::Cut;
  if (charts == kOneChart) job.options.limit = StretchLimit::Reported;
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
                  {"charts", charts}});
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

// The .obj among the outputs; null where there is none.
const std::string* baked_output(const std::vector<std::string>& files) {
  const auto found = std::find_if(files.begin(), files.end(), [](const std::string& path) {
    return extension(path) == ".obj";
  });
  return found == files.end() ? nullptr : &*found;
}

// What --bake needs, and the files that it writes.
std::vector<std::string> baked_files(const UnwrapVerb& request) {
  if (!request.unwrap.bake) return {};
  const std::string* const obj = baked_output(request.outputs.files);
  if (format_of(request.map.input) != ".obj" || obj == nullptr)
    throw Error(ErrorKind::Usage,
                "--bake moves the texture of an OBJ and needs one as output, too: -o OUT.obj");
  return {texture_file(*obj), material_file(*obj)};
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

void require_layout(const UnwrapVerb& request) {
  const LayoutRequest& layout = request.unwrap.layout;
  require_islands(request);
  if (request.unwrap.bake && layout.udim > 0)
    throw Error(ErrorKind::Usage,
                "--bake makes one image, --udim one for every tile; leave one of "
                "the two out");
  require_stackable(request);
  if (layout.groups && baked_output(request.outputs.files) == nullptr)
    throw Error(ErrorKind::Usage, "--groups: groups are of .obj; add -o OUT.obj");
}

void require_usable(UnwrapVerb& request) {
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
  require_writable(request.common,
                   {{baked_files(request), {".png", ".mtl"}},
                    {request.outputs.files, request.outputs.extensions},
                    {{request.outputs.distortion}, {".csv"}}},
                   {request.map.input, request.map.pins, request.map.handles, request.map.weights,
                    request.unwrap.seams.file(), request.unwrap.layout.density_file(),
                    request.outputs.formats.readable_image()});
}

// A run of unwrap that has ended. Only refers: all must outlive it.
struct FinishedUnwrap {
  const CommonOptions& common;
  const OutputRequest& outputs;
  const MapRequest& map;
  const AtlasJob& job;
  std::chrono::steady_clock::time_point start;  // of the run
  Progress& progress;
  const std::optional<ObjTexture>& texture;  // to be baked
  const LayoutRequest& layout;
};

// The mesh that an OBJ of this name is written with.
PolygonMesh marked_polygons(const FinishedUnwrap& run, const std::string& path,
                            const MapFile& file) {
  PolygonMesh mesh = *run.job.polygons;
  if (run.texture) mesh = with_material_file(std::move(mesh), path);
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
        const bool is_marked = is_obj && (run.texture || run.layout.udim > 0 || run.layout.groups);
        PolygonMesh marked;
        if (is_marked) marked = marked_polygons(run, path, file);
        write_map(path, file, is_marked ? &marked : run.job.polygons.get(), formats,
                  proof_of_file(path, promise(run.job, path), file, formats));
        if (run.common.quiet) return;
        std::vector<std::string> left = left_out(path, file, formats, run.job.polygons.get());
        if (is_obj)
          for (std::string& what : replaced(run)) left.push_back(std::move(what));
        say_left_out(path, left);
      });
  if (!run.texture) return;
  const std::string& obj = *baked_output(run.outputs.files);
  if (written.has(obj))
    written.write(texture_file(obj), [&] {
      or_interrupted("baking " + texture_file(obj), [&] {
        bake_texture(*run.texture, *run.job.polygons, obj, run.job.record.stop());
      });
    });
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

std::string chart_name(const FinishedUnwrap& run, std::size_t k) {
  const Chart& chart = run.job.atlas.charts[k];
  return fmt::format("{}: chart {} (face {} and {} more)", run.map.input, k + 1,
                     run.job.surface.mesh->input_face(chart.faces.front()) + 1,
                     chart.faces.size() - 1);
}

// Charts that did not converge, by their first faces, and those that stretch more than they may.
void name_charts(const FinishedUnwrap& run) {
  for (std::size_t k = 0; k < run.job.atlas.charts.size(); ++k) {
    const Chart& chart = run.job.atlas.charts[k];
    if (chart.status != Status::Converged)
      say("majorant: {}: {}{}\n", chart_name(run, k), status_name(chart.status),
          chart.message.empty() ? "" : ": " + chart.message);
    if (const std::string why = why_stretched(run.job.options, chart); !why.empty())
      say("majorant: {}: stretch {:.4f}, more than --max-stretch {:g}: {}\n", chart_name(run, k),
          chart.stretch.l2, run.job.options.cuts.max_stretch, why);
  }
}

void summarize(const FinishedUnwrap& run, const WrittenFiles& written) {
  const Atlas& atlas = run.job.atlas;
  name_charts(run);
  if (run.common.quiet || atlas.status() == Status::Failed) return;
  for (const Repair& r : run.job.surface.repairs) say("{}: {}\n", run.map.input, describe(r));
  say_untextured(run.map.input, atlas.cuts);
  written.say_sizes();
  const std::string fill = atlas.packing ? fmt::format(", fill {:.2f}", atlas.packing->fill) : "";
  say("{}: {}, {} chart{}, {} {:.6f}, seams {:.4g} ({:.3g} sqrt(area)), stretch {:.4f}{}, "
      "degree {}, {}, {:.2f} s\n",
      run.map.input, status_name(atlas.status()), atlas.charts.size(),
      atlas.charts.size() == 1 ? "" : "s", run.map.energy, atlas.value(), seam_length(run.job),
      seam_length(run.job) / std::sqrt(run.job.surface.mesh->area()), atlas.stretch().l2, fill,
      run.map.degree, overlap_words(run.job.boundary, ImageOf::Charts), seconds_since(run.start));
  for (const std::string& path : run.outputs.files)
    if (is_map_data(path) && written.has(path))
      say("proof: majorant check {}{}\n", path, atlas.packing ? " --certify" : "");
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

int unwrap_file(UnwrapVerb request) {
  const auto start = std::chrono::steady_clock::now();
  Progress progress(request.common, {Activity::Reading, Activity::Cutting, Activity::Solving,
                                     Activity::Packing, Activity::Proving, Activity::Writing});
  RunRecord record = request.solve.make_record(progress);
  require_usable(request);
  const ThreadCount threads(usable_threads(request.common.threads));
  AtlasJob job(record);
  std::optional<ObjTexture> texture;
  job.energy = request.map.energy;
  record.begin(Activity::Reading);
  or_interrupted("reading " + request.map.input, [&] {
    const Strictness strictness = request.common.strictness(
        request.unwrap.keep_seams ? Strictness::Texcoords : request.unwrap.seams.needed_of_file());
    PolygonMesh polygons = within_memory(request.map.input, [&] {
      return read_mesh(request.map.input, record.start_stop(), strictness);
    });
    say_warnings(polygons.warnings);
    request.outputs.require_materials(polygons);
    if (request.unwrap.bake) {
      texture = within_memory(request.map.input,
                              [&] { return read_obj_texture(polygons, record.start_stop()); });
      say_warnings(texture->warnings);
    }
    request.unwrap.open(job, std::move(polygons), strictness);
    job.options.chart = read_options(request.map, *job.polygons, *job.surface.mesh,
                                     record.start_stop(), job.surface.welded);
    request.unwrap.layout.apply(job, record.start_stop());
  });
  request.solve.apply(job.options.chart);
  LinearSolvers solvers(request.solve.linear_solver, "", request.common.quiet,
                        LinearSolvers::Runs::Several);
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
  return write_atlas({request.common, request.outputs, request.map, job, start, progress, texture,
                      request.unwrap.layout});
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
