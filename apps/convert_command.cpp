// majorant convert RESULT -o OUT...: other formats of a finished map, without solving again.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <memory>

#include "apps/arguments/help_text.h"
#include "apps/command.h"
#include "apps/outputs.h"
#include "apps/page_content.h"
#include "apps/process.h"
#include "apps/streams.h"
#include "apps/within_memory.h"
#include "majorant/certify/cut_map.h"
#include "majorant/certify/moved_layout.h"
#include "majorant/framework/parallel.h"
#include "majorant/io/claims.h"
#include "majorant/io/io.h"
#include "majorant/io/layout_scale.h"
#include "majorant/io/read_mesh.h"
#include "majorant/parametrization/maps/smallest_rectangle.h"
#include "majorant/pictures/turned_over.h"
#include "majorant/results/check_map.h"
#include "majorant/results/report.h"

namespace majorant::app {
namespace {

struct ConvertRequest {
  CommonOptions common;
  std::string input, positional_output, distortion;
  std::vector<std::string> outputs;
  FormatOptions formats;
};

// Files other than ours do not mark seams and cones: the points tell where they are. A map that is
// cut in another way stays as it is.
void mark_seams(MapFile& map, const std::string& name) {
  if (map.seam_edges.size() > 0 || !is_cut(map)) return;
  try {
    const BezierMap seamless = CutMap(map, name).map_with_seams();
    if (seamless.seams().trivial()) return;  // points that no cut needs
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

// The claim that would not be true any more of a map that is turned; empty: none.
std::string what_holds(const MapFile& map, const Claims& claims) {
  if (held_by(claims) == Held::Points) return "pins or handles hold it";
  if (held_by(claims) == Held::Boundary) return "its boundary is held fixed";
  if (map.chart.size() > 0) return "its charts are packed";
  if (claims.normalized) return "it lies in the unit square";
  return {};
}

// Turned until its longer side lies, which its claims say then. One that they say lies already
// stays.
void align(MapFile& map, const std::string& name) {
  const Claims claims = parse_claims(map.claims, name);
  if (const std::string reason = what_holds(map, claims); !reason.empty())
    throw Error(ErrorKind::Usage,
                fmt::format("{}: --align would turn the layout in data files and pages, and {}; "
                            "leave it out, or ask for .svg and .png alone",
                            name, reason));
  if (claims.aligned) return;
  const Vector2 direction = layout_direction(map.uv, map.cells);
  map.uv = LayoutMotion{direction}(map.uv);
  map.uv_rounding.resize(0, 2);  // what a file would have to be these
  if (map.claims.empty()) return;
  Json all = Json::parse(map.claims);
  all["aligned"] = {{"direction", {direction.x(), direction.y()}}};
  map.claims = json_text(all);
}

// The page of a map, with what `check` finds it to be.
MapPage page_of(const MapFile& map, const std::string& name) {
  MapCheck check(map, {.name = name, .reported = true}, RunRecord());
  check.report["command"] = "convert";
  return checked_page(map, check, {name});
}

// Arrays of a file whose scale is assumed would claim what it does not.
void measure(const ConvertRequest& request, MapFile& map, WrittenFiles& written) {
  const MapDistortion measured = measure_distortion(map);
  const bool is_assumed = has_assumed_scale(map);
  map.face_distortion = is_assumed ? FaceDistortion() : finite_or_none(measured.faces);
  const std::string& path = request.distortion;
  if (path.empty()) return;
  if (is_assumed && !request.common.quiet)
    say("{}: claims no scale: measured with the layout as large as the surface, uv times {:.6g}\n",
        request.input, layout_scale(map));
  written.write(path, [&] { write_distortion(path, map, measured.faces); });
}

// The parts of the converted file that the output does not hold.
std::vector<std::string> left_out_of(const std::string& path, const MapFile& map,
                                     const MapFormats& formats) {
  std::vector<std::string> what = left_out(path, map, formats, nullptr);
  if (!is_map_data(path) || extension(path) == ".vtu") return what;
  if (is_straight_map_data(path) && map.chart.size() > 0) what.emplace_back("charts");
  if (map.seam_edges.size() > 0) what.emplace_back("marks of seams and cones");
  if (!map.claims.empty()) what.emplace_back("claims");
  return what;
}

// Where there are pictures to see it in.
void say_turned_over(const ConvertRequest& request, const MapFile& map) {
  const auto is_picture = [](const std::string& path) {
    return extension(path) == ".svg" || extension(path) == ".png";
  };
  if (!std::any_of(request.outputs.begin(), request.outputs.end(), is_picture)) return;
  if (const std::size_t count = turned_over_cells(map).size(); count > 0)
    say("{}: {}, magenta in pictures\n", request.input, turned_over_words(count));
}

void write_report(const ConvertRequest& request, const MapFile& map, WrittenFiles& written) {
  const Json report{{"schema_version", 1},      {"version", MAJORANT_VERSION},
                    {"command", "convert"},     {"input", {{"file", request.input}}},
                    {"warnings", map.warnings}, {"outputs", written.to_json()}};
  written.write(request.common.report, [&] { write_json(request.common.report, report); });
}

int convert(ConvertRequest request) {
  if (!request.positional_output.empty()) request.outputs.push_back(request.positional_output);
  if (request.distortion.empty()) require_some_output(request.outputs, map_extensions());
  request.formats.read_image();
  require_writable(request.common,
                   {{request.outputs, map_extensions()}, {{request.distortion}, {".csv"}}},
                   {request.input, request.formats.image});
  request.formats.require_effect(request.outputs);
  const ThreadCount threads(usable_threads(request.common.threads));
  MapFile map = within_memory(
      request.input, [&] { return read_map(request.input, {}, request.common.strictness()); });
  say_warnings(map.warnings);
  mark_seams(map, request.input);
  if (request.formats.turns_map(request.outputs)) align(map, request.input);
  const PolygonMesh surface = mesh_from_map(map, request.input);
  const ProofRequest promise = promise_of(map, surface, request.input);
  request.formats.tessellation.overlap = allowed_overlap(promise);
  request.formats.svg.points = request.formats.png.points =
      claimed_points(parse_claims(map.claims, request.input), map);
  if (has_page(request.outputs)) request.formats.page = page_of(map, request.input);
  WrittenFiles written;
  measure(request, map, written);
  for (const std::string& path : request.outputs)
    written.write(path, [&] {
      write_map(path, map, nullptr, request.formats,
                proof_of_file(path, promise, map, request.formats));
      if (!request.common.quiet) say_left_out(path, left_out_of(path, map, request.formats));
    });
  if (!request.common.report.empty()) write_report(request, map, written);
  if (!request.common.quiet) {
    say_turned_over(request, map);
    written.say_sizes();
  }
  return written.conclude(kSuccess);
}

}  // namespace

void add_convert(CLI::App& app, Action* run) {
  auto request = std::make_shared<ConvertRequest>();
  CLI::App& verb = *app.add_subcommand("convert", "write a finished map in other formats");
  begin_group(verb, OptionGroup::Files);
  verb.add_option("result", request->input,
                  "result: .vtu, .msh, or .obj, .ply, .glb or .gltf with texture coordinates")
      ->required();
  verb.add_option("output", request->positional_output, "output file, same as -o");
  verb.add_option("-o,--output", request->outputs, output_help(map_extensions()))
      ->type_name("FILE")
      ->allow_extra_args(false);
  request->formats.add_to(verb);
  begin_group(verb, OptionGroup::Files);
  verb.add_option("--distortion", request->distortion,
                  "write a table of stretch, area and angle distortion per face to FILE.csv")
      ->type_name("FILE");
  request->common.add_to(verb);
  verb.footer("Example: majorant convert bunny.vtu -o bunny.obj --refine 8");
  verb.callback([request, run] { *run = [request] { return convert(*request); }; });
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
