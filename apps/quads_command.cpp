// majorant quads IN -o OUT...: a pure quad mesh of a surface. docs/quads.md.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <limits>
#include <memory>
#include <optional>

#include "apps/arguments/number_check.h"
#include "apps/arguments/option_table.h"
#include "apps/command.h"
#include "apps/outputs.h"
#include "apps/page_content.h"
#include "apps/run.h"
#include "apps/streams.h"
#include "majorant/apps/jobs/quad_job.h"
#include "majorant/apps/jobs/quad_report.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/files/standard_stream.h"
#include "majorant/io/read_mesh.h"
#include "majorant/io/read_vertex_lists.h"
#include "majorant/mesh/geometry.h"
#include "majorant/pictures/quad_picture.h"

namespace majorant::app {
namespace {

struct QuadsRequest {
  CommonOptions common;
  std::string input, positional_output, cones, features;
  std::vector<std::string> outputs;
  std::optional<long> count;
  std::optional<double> edge_length, border_corners;
  double time_limit = std::numeric_limits<double>::infinity();
};

std::vector<std::string> written_extensions() {
  std::vector<std::string> all = extensions_for(FormatUse::WriteQuads);
  for (const std::string& picture : extensions_for(FormatUse::Show)) all.push_back(picture);
  return all;
}

void open(const QuadsRequest& request, QuadJob& job, const Run& run) {
  PolygonMesh polygons = run.read(request.input, [&] {
    return read_mesh(request.input, run.start_stop(), request.common.strictness());
  });
  say_warnings(polygons.warnings);
  run.make("reading " + request.input, [&] {
    job.open(std::move(polygons));
    if (request.common.strict && !job.surface.repairs.empty())
      throw Error(ErrorKind::Unsupported,
                  fmt::format("{}: {}; leave out --strict to have it repaired so", request.input,
                              describe(job.surface.repairs.front())));
    if (!request.cones.empty())
      job.options.map.cones = read_cones(
          request.cones, static_cast<Index>(job.polygons.positions.size()), run.start_stop());
    if (!request.features.empty())
      job.options.features =
          features_of(request.features, job.polygons, job.surface, run.start_stop());
  });
}

void write_output(const QuadsRequest& request, const QuadJob& job, const std::string& path) {
  const QuadPicture picture = picture_of(job, page_title(request.input));
  using Picture = Format::Picture;
  const Picture shown = find_format(format_of(path))->picture;
  if (shown == Picture::Drawing) return write_svg(path, picture);
  if (shown == Picture::Image) return write_png(path, picture);
  if (shown == Picture::None)
    return write_quads(path, job.quads, *job.surface.mesh, job.features, job.patch_of,
                       job.options.border_turn);
  MapPage page = page_of(picture);
  page.facts = page_facts(quad_report(job), {request.input, request.cones});
  write_page(path, page);
}

constexpr double kHundredth = 0.01;
constexpr double kHalfTurn = 180;  // degrees

std::vector<std::string> summary_of(const QuadsRequest& request, const QuadJob& job,
                                    const WrittenFiles& written, double seconds) {
  std::vector<std::string> lines{
      fmt::format("{}: {}, {}; {} requested{}, {:.2f} s", request.input, status_name(job.status),
                  describe(job.check, QuadsComparedWith::Surface), job.requested_count,
                  job.least_count ? fmt::format(", {} at least", *job.least_count) : "", seconds)};
  // Relaxed features are not covered, so `check` cannot demand them.
  const std::string features =
      job.feature_lines > 0 && job.relaxed.empty()
          ? " --features " +
                (request.features.empty() ? fmt::format("{}", kCornerTurn) : request.features)
          : "";
  const std::string corners = job.options.border_turn == kCornerTurn
                                  ? ""
                                  : fmt::format(" --border-corners {:g}", job.options.border_turn);
  const double distance =
      std::max(job.check.hausdorff.to_surface, job.check.hausdorff.from_surface) /
      diagonal(job.surface.mesh->positions());
  // Large quads deviate more from a curved surface. The tolerance is rounded up to hundredths.
  const std::string far = distance > kMaxQuadDistance
                              ? fmt::format(" --max-distance {:.2f}", distance + kHundredth)
                              : "";
  for (const std::string& path : request.outputs)
    if (written.has(path) && !is_for(FormatUse::Show, path) && !is_standard_output(path))
      lines.push_back(fmt::format("proof: majorant check {} --surface {}{}{}{}{}", path,
                                  request.input, has_quads_as_cells(path) ? " --quads" : "",
                                  features, corners, far));
  return lines;
}

Made quads_of(const QuadsRequest& request, QuadJob& job, Run& run) {
  open(request, job, run);
  job.read_seconds = run.seconds();
  job.options.count = request.count;
  job.options.edge_length = request.edge_length;
  job.options.border_turn = request.border_corners.value_or(kCornerTurn);
  job.options_json = {
      {"count", request.count ? Json(*request.count) : Json()},
      {"edge_length", request.edge_length ? Json(*request.edge_length) : Json()},
      {"cones", request.cones},
      {"border_corners", request.border_corners ? Json(*request.border_corners) : Json()},
      {"features", request.features.empty() ? Json() : Json(request.features)},
      {"strict", request.common.strict}};
  run.make("making quads of " + request.input, [&] { job.solve(request.cones); });
  say_warnings(job.warnings);
  Made made{.report = quad_report(job)};
  for (const std::string& path : request.outputs)
    made.files.push_back({path, [&, path] { write_output(request, job, path); }});
  for (const Repair& repair : job.surface.repairs)
    made.remarks.push_back(fmt::format("{}: {}", request.input, describe(repair)));
  made.summary = [&](const WrittenFiles& written) {
    return summary_of(request, job, written, run.seconds());
  };
  return made;
}

int make_quads(QuadsRequest request) {
  if (!request.positional_output.empty()) request.outputs.push_back(request.positional_output);
  require_some_output(request.outputs, written_extensions());
  const RunPlan plan{.command = "quads",
                     .common = request.common,
                     .inputs = {request.input, request.cones, feature_file(request.features)},
                     .outputs = {{request.outputs, written_extensions()}},
                     .stages = {Activity::Reading, Activity::Starting, Activity::Solving,
                                Activity::Proving, Activity::Writing},
                     .time_limit = request.time_limit,
                     .max_iterations = StoppingRules().max_iterations};
  Run run(plan);
  QuadJob job(run.record());
  return run.conclude([&](Run&) { return quads_of(request, job, run); });
}

}  // namespace

void add_quads(CLI::App& app, Action* run) {
  auto request = std::make_shared<QuadsRequest>();
  QuadsRequest& r = *request;
  CLI::App& verb = *app.add_subcommand("quads", "make a pure quad mesh of a surface");
  constexpr double kAnySeconds = std::numeric_limits<double>::infinity();
  add_options(verb, OptionGroup::Files,
              {{"input", &r.input, "surface mesh", {.required = true}},
               {"output", &r.positional_output, "output file, same as -o"},
               {"-o,--output", &r.outputs, output_help(written_extensions()), {.type = "FILE"}}});
  add_options(
      verb, OptionGroup::Map,
      {{"--count",
        &r.count,
        "number of quads (half the number of faces)",
        {.check = whole_number(1, kMaxQuads)}},
       {"--edge-length",
        &r.edge_length,
        "edge length of the quads, in model units",
        {.check = positive_number(std::numeric_limits<double>::max()), .excludes = {"--count"}}},
       {"--cones",
        &r.cones,
        "JSON file of irregular vertices (default: the cones of a smooth cross field)",
        {.type = "FILE"}},
       {"--features",
        &r.features,
        "feature lines that edges of quads follow: inner edges where the normals of the faces "
        "differ by DEG degrees or more (35; none with --cones), the edges of a JSON FILE, or none",
        {.type = "DEG|FILE|none"}},
       {"--border-corners",
        &r.border_corners,
        "turn of the border, in degrees, from which on quads get a vertex there (35); 180 smooths "
        "all of it, which suits torn borders of scans",
        {.type = "DEG", .check = positive_number(kHalfTurn)}},
       {"--time-limit",
        &r.time_limit,
        "time limit in seconds; quads are then made from the map as it is, and nothing is written "
        "if there is none",
        {.check = non_negative_number(kAnySeconds)}}});
  r.common.add_to(verb);
  verb.footer("Example: majorant quads spot.obj -o quads.obj --count 4000");
  verb.callback([request, run] { *run = [request] { return make_quads(*request); }; });
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
