// majorant convert RESULT -o OUT...: writes a finished map in other formats, without solving again.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <memory>
#include <optional>

#include "apps/command.h"
#include "apps/output_request.h"
#include "apps/outputs.h"
#include "apps/page_content.h"
#include "apps/run.h"
#include "apps/streams.h"
#include "majorant/apps/jobs/check_map.h"
#include "majorant/apps/jobs/report.h"
#include "majorant/certify/cut_map.h"
#include "majorant/certify/moved_layout.h"
#include "majorant/io/claims.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/io.h"
#include "majorant/io/layout_scale.h"
#include "majorant/io/read_mesh.h"
#include "majorant/maps/smallest_rectangle.h"
#include "majorant/pictures/turned_over.h"

namespace majorant::app {
namespace {

struct ConvertRequest {
  CommonOptions common;
  std::string input, positional_output, distortion;
  std::vector<std::string> outputs;
  FormatOptions formats;
};

// Marks seams and cones of a map from a foreign file, from its points alone. A map with other cuts
// stays unchanged.
void mark_seams(MapFile& map, const std::string& name) {
  if (map.seam_edges.size() > 0 || !is_cut(map)) return;
  try {
    const BezierMap seamless = CutMap(map, name).map_with_seams();
    if (seamless.seams().trivial()) return;  // no cut needs these points
    const MapFile marked = to_map_file(seamless);
    map.seam_edges = marked.seam_edges;
    map.cone = Eigen::VectorXi::Zero(map.points.rows());
    for (Index c = 0; c < map.cells.rows(); ++c)
      for (Index k = 0; k < 3; ++k) map.cone[map.cells(c, k)] = marked.cone[marked.cells(c, k)];
  } catch (const Error&) {
    map.seam_edges.resize(0, 3);
    map.cone.resize(0);
  }
}

// Returns the claim that would be false after a rotation of the map; empty if there is none.
std::string what_holds(const MapFile& map, const Claims& claims) {
  if (held_by(claims) == Held::Points) return "pins or handles hold it";
  if (held_by(claims) == Held::Boundary) return "its boundary is held fixed";
  if (map.chart.size() > 0) return "its charts are packed";
  if (claims.normalized) return "it lies in the unit square";
  return {};
}

// Turns a map until its longer side is horizontal, and claims this. A map that already claims it
// stays unchanged.
void align(MapFile& map, const std::string& name) {
  const Claims claims = parse_claims(map.claims, name);
  if (const std::string reason = what_holds(map, claims); !reason.empty())
    throw Error(ErrorKind::Usage,
                fmt::format("{}: --align would turn the layout in data files and pages, but {}; "
                            "leave it out, or write .svg and .png alone",
                            name, reason));
  if (claims.aligned) return;
  const Vector2 direction = layout_direction(map.uv, map.cells);
  map.uv = LayoutMotion{direction}(map.uv);
  map.uv_rounding.resize(0, 2);  // claims that the turned map no longer satisfies
  if (map.claims.empty()) return;
  Json all = Json::parse(map.claims);
  all["aligned"] = {{"direction", {direction.x(), direction.y()}}};
  map.claims = json_text(all);
}

// Returns the page of a map with the findings of `check`.
MapPage page_of(const MapFile& map, const std::string& name) {
  MapCheck check(map, {.name = name, .reported = true}, RunRecord());
  check.report.command = "convert";
  return checked_page(map, check, {name});
}

// Returns the parts of the converted file that the output cannot hold.
std::vector<std::string> left_out_of(const std::string& path, const MapFile& map,
                                     const MapFormats& formats, const PolygonMesh* input) {
  std::vector<std::string> what = left_out(path, map, formats, input);
  if (!is_map_data(path) || written_format(path)->has_claims) return what;
  if (is_straight_map_data(path) && map.chart.size() > 0) what.emplace_back("charts");
  if (map.seam_edges.size() > 0) what.emplace_back("marks of seams and cones");
  if (!map.claims.empty()) what.emplace_back("claims");
  return what;
}

// Returns remarks about cells that pictures show in magenta, and about cells without area.
std::vector<std::string> turned_over_in_words(const ConvertRequest& request, const MapFile& map) {
  const auto is_picture = [](const std::string& path) {
    return is_shown_as(Format::Picture::Drawing, path) || is_shown_as(Format::Picture::Image, path);
  };
  if (!std::any_of(request.outputs.begin(), request.outputs.end(), is_picture)) return {};
  std::vector<std::string> lines;
  if (const std::size_t over = turned_over_cells(map).size(); over > 0)
    lines.push_back(
        fmt::format("{}: {}, magenta in pictures", request.input, turned_over_words(over)));
  if (const std::size_t flat = cells_without_area(map).size(); flat > 0)
    lines.push_back(fmt::format("{}: {}", request.input, without_area_words(flat)));
  return lines;
}

// The map of a file in the form that outputs take.
struct Conversion {
  MapFile map;
  std::optional<PolygonMesh> polygons;  // the mesh and its materials, for glTF output
  MapDistortion distortion;
  PolygonMesh surface;
  ProofRequest proof;
};

// The proof of `c` refers to its surface.
void read(const ConvertRequest& request, Run& run, Conversion& c) {
  const bool may_have_materials = may_have_texture(request.input);
  const bool is_to_gltf = std::any_of(request.outputs.begin(), request.outputs.end(), is_gltf);
  c.map = run.read(request.input, [&] {
    if (!may_have_materials || !is_to_gltf)
      return read_map(request.input, run.stop(), request.common.strictness());
    c.polygons = read_mesh(request.input, run.stop(),
                           std::max(request.common.strictness(), Strictness::Texcoords));
    return to_map_file(*c.polygons);
  });
  if (!c.map.is_complete) c.polygons.reset();
  say_warnings(c.map.warnings);
  mark_seams(c.map, request.input);
  if (request.formats.turns_map(request.outputs)) align(c.map, request.input);
  c.surface = mesh_from_map(c.map, request.input);
  c.proof = proof_request(c.map, c.surface, request.input);
  if (c.proof.cuts == CutRule::Seams) require_holds_seams(request.outputs);
  c.distortion = measure_distortion(c.map);
  // Arrays of a file with an assumed scale would claim values that are not its own.
  c.map.face_distortion =
      has_assumed_scale(c.map) ? FaceDistortion() : finite_or_none(c.distortion.faces);
}

Made converted(ConvertRequest& request, Conversion& c, Run& run) {
  read(request, run, c);
  request.formats.read_image(run.stop());
  FormatOptions& formats = request.formats;
  formats.tessellation.overlap = allowed_overlap(c.proof);
  formats.svg.points = formats.png.points =
      claimed_points(parse_claims(c.map.claims, request.input), c.map);
  if (has_page(request.outputs)) formats.page = page_of(c.map, request.input);
  Made made{.report = {.status = "done",
                       .input = {{"file", request.input}},
                       .options = {{"refine", formats.tessellation.refine},
                                   {"strict", request.common.strict}},
                       .result = {{"degree", c.map.degree}, {"cells", c.map.cells.rows()}},
                       .warnings = c.map.warnings}};
  if (const std::string& path = request.distortion; !path.empty()) {
    if (has_assumed_scale(c.map))
      made.remarks.push_back(fmt::format(
          "{}: claims no scale: measured with the layout as large as the surface, uv times {:.6g}",
          request.input, layout_scale(c.map)));
    made.files.push_back({path, [&, path] { write_distortion(path, c.map, c.distortion.faces); }});
  }
  for (const std::string& path : request.outputs)
    made.files.push_back(
        {path, [&, path] {
           const PolygonMesh* const input = is_gltf(path) && c.polygons ? &*c.polygons : nullptr;
           const std::string note =
               write_map(path, c.map, input, formats, proof_of_file(path, c.proof, c.map, formats));
           if (run.is_quiet()) return;
           say_left_out(path, left_out_of(path, c.map, formats, input));
           if (!note.empty()) say("{}: {}\n", path, note);
         }});
  for (std::string& line : turned_over_in_words(request, c.map))
    made.remarks.push_back(std::move(line));
  return made;
}

int convert(ConvertRequest request) {
  if (!request.positional_output.empty()) request.outputs.push_back(request.positional_output);
  if (request.distortion.empty()) require_some_output(request.outputs, map_extensions());
  request.formats.require_effect(request.outputs);
  const RunPlan plan{
      .command = "convert",
      .common = request.common,
      .inputs = {request.input, request.formats.image},
      .outputs = {{request.outputs, map_extensions()}, {{request.distortion}, {".csv"}}},
      .stages = {}};
  Conversion conversion;
  return run_verb(plan, [&](Run& run) { return converted(request, conversion, run); });
}

}  // namespace

void add_convert(CLI::App& app, Action* run) {
  auto request = std::make_shared<ConvertRequest>();
  CLI::App& verb = *app.add_subcommand("convert", "write a finished map in other formats");
  add_options(
      verb, OptionGroup::Files,
      {{"result", &request->input, "result: " + result_help(), {.required = true}},
       {"output", &request->positional_output, "output file, same as -o"},
       {"-o,--output", &request->outputs, output_help(map_extensions()), {.type = "FILE"}}});
  request->formats.add_to(verb);
  add_options(verb, OptionGroup::Files, {distortion_option(&request->distortion)});
  request->common.add_to(verb);
  verb.footer("Example: majorant convert bunny.vtu -o bunny.obj --refine 8");
  verb.callback([request, run] { *run = [request] { return convert(*request); }; });
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
