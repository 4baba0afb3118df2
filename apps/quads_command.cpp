// majorant quads IN -o OUT...: a pure quad mesh of a surface. docs/quads.md.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>
#include <optional>

#include "apps/arguments/help_text.h"
#include "apps/arguments/number_check.h"
#include "apps/command.h"
#include "apps/or_interrupted.h"
#include "apps/outputs.h"
#include "apps/page_content.h"
#include "apps/process.h"
#include "apps/progress.h"
#include "apps/streams.h"
#include "apps/within_memory.h"
#include "majorant/framework/parallel.h"
#include "majorant/io/input_file.h"
#include "majorant/io/read_mesh.h"
#include "majorant/io/read_vertex_lists.h"
#include "majorant/io/waiting_output.h"
#include "majorant/pictures/quad_picture.h"
#include "majorant/results/quad_job.h"
#include "majorant/results/quad_report.h"

namespace majorant::app {
namespace {

struct QuadsRequest {
  CommonOptions common;
  std::string input, positional_output, cones, features;
  std::vector<std::string> outputs;
  std::optional<long> count;
  std::optional<double> edge_length;
  double time_limit = std::numeric_limits<double>::infinity();
};

std::vector<std::string> written_extensions() {
  std::vector<std::string> all = quad_extensions();
  for (const std::string& picture : quad_picture_extensions()) all.push_back(picture);
  return all;
}

void require_usable(QuadsRequest& request) {
  if (!request.positional_output.empty()) request.outputs.push_back(request.positional_output);
  require_some_output(request.outputs, written_extensions());
  require_writable(request.common, {{request.outputs, written_extensions()}},
                   {request.input, request.cones, feature_file(request.features)});
}

void open(const QuadsRequest& request, QuadJob& job) {
  or_interrupted("reading " + request.input, [&] {
    PolygonMesh polygons = within_memory(request.input, [&] {
      return read_mesh(request.input, job.record.start_stop(), request.common.strictness());
    });
    say_warnings(polygons.warnings);
    job.open(std::move(polygons));
    if (request.common.strict && !job.surface.repairs.empty())
      throw Error(ErrorKind::Unsupported,
                  fmt::format("{}: {}; leave out --strict to have it repaired so", request.input,
                              describe(job.surface.repairs.front())));
    if (!request.cones.empty())
      job.options.map.cones =
          read_cones(request.cones, static_cast<Index>(job.polygons.positions.size()),
                     job.record.start_stop());
    if (!request.features.empty())
      job.options.features =
          features_of(request.features, job.polygons, job.surface, job.record.start_stop());
  });
}

bool is_picture(const std::string& path) {
  const std::vector<std::string> pictures = quad_picture_extensions();
  return std::count(pictures.begin(), pictures.end(), format_of(path)) > 0;
}

void write_output(const QuadsRequest& request, const QuadJob& job, const std::string& path) {
  const QuadPicture picture = picture_of(job, page_title(request.input));
  const std::string format = format_of(path);
  if (format == ".svg") return write_svg(path, picture);
  if (format == ".png") return write_png(path, picture);
  if (format != ".html")
    return write_quads(path, job.quads, *job.surface.mesh, job.features, job.patch_of);
  MapPage page = page_of(picture);
  page.facts = page_facts(quad_report(job), {request.input, request.cones});
  write_page(path, page);
}

void summarize(const QuadsRequest& request, const QuadJob& job, const WrittenFiles& written,
               double seconds) {
  if (request.common.quiet) return;
  for (const Repair& repair : job.surface.repairs) say("{}: {}\n", request.input, describe(repair));
  written.say_sizes();
  say("{}: {}, {}; {} asked{}, {:.2f} s\n", request.input, status_name(job.status),
      describe(job.check, QuadsComparedWith::Surface), job.asked_count,
      job.least_count ? fmt::format(", {} at least", *job.least_count) : "", seconds);
  // Relaxed features are not covered; what else is proven is.
  const std::string features =
      job.feature_lines > 0 && job.relaxed.empty()
          ? " --features " +
                (request.features.empty() ? fmt::format("{}", kCornerTurn) : request.features)
          : "";
  for (const std::string& path : request.outputs)
    if (written.has(path) && !is_picture(path))
      say("proof: majorant check {} --surface {}{}{}\n", path, request.input,
          format_of(path) == ".vtu" ? " --quads" : "", features);
}

int make_quads(QuadsRequest request) {
  const auto start = std::chrono::steady_clock::now();
  require_usable(request);
  const ThreadCount threads(usable_threads(request.common.threads));
  Progress progress(request.common, {Activity::Reading, Activity::Starting, Activity::Solving,
                                     Activity::Proving, Activity::Writing});
  RunRecord record(request.time_limit, StoppingRules().max_iterations, interruption_flag(),
                   &progress);
  set_output_stop(record.stop());
  QuadJob job(record);
  record.begin(Activity::Reading);
  open(request, job);
  job.read_seconds = record.seconds();
  job.options.count = request.count;
  job.options.edge_length = request.edge_length;
  job.asked = {{"count", request.count ? Json(*request.count) : Json()},
               {"edge_length", request.edge_length ? Json(*request.edge_length) : Json()},
               {"cones", request.cones},
               {"features", request.features.empty() ? Json() : Json(request.features)},
               {"strict", request.common.strict}};
  or_interrupted("making quads of " + request.input, [&] { job.solve(request.cones); });
  say_warnings(job.warnings);
  record.begin(Activity::Writing);
  const double before = seconds_since(start);
  WrittenFiles written;
  for (const std::string& path : request.outputs)
    written.write(path, [&] { write_output(request, job, path); });
  if (const std::string& path = request.common.report; !path.empty()) {
    Json report = quad_report(job);
    report["outputs"] = written.to_json();
    report["seconds"]["write"] = seconds_since(start) - before;
    report["seconds"]["total"] = seconds_since(start);
    written.write(path, [&] { write_json(path, report); });
  }
  progress.finish();
  summarize(request, job, written, seconds_since(start));
  return written.conclude(exit_code(job.status));
}

}  // namespace

void add_quads(CLI::App& app, Action* run) {
  auto request = std::make_shared<QuadsRequest>();
  QuadsRequest& r = *request;
  CLI::App& verb = *app.add_subcommand("quads", "make a pure quad mesh of a surface");
  begin_group(verb, OptionGroup::Files);
  verb.add_option("input", r.input, "mesh of a surface")->required();
  verb.add_option("output", r.positional_output, "one more output");
  verb.add_option("-o,--output", r.outputs, output_help(written_extensions()))
      ->type_name("FILE")
      ->allow_extra_args(false);
  begin_group(verb, OptionGroup::Map);
  CLI::Option* const count =
      verb.add_option("--count", r.count, "number of quads (half the number of faces)")
          ->check(whole_number(1, kMostQuads));
  verb.add_option("--edge-length", r.edge_length, "length of the edges of quads, model units")
      ->check(positive_number(std::numeric_limits<double>::max()))
      ->excludes(count);
  verb.add_option("--cones", r.cones,
                  "the irregular vertices, JSON (default: the cones of a smooth cross field)")
      ->type_name("FILE");
  verb.add_option(
          "--features", r.features,
          "edges that edges of quads cover: those inside with so many degrees between the "
          "normals of their faces (35; none where --cones is given), those of a file, JSON, "
          "or none")
      ->type_name("DEG|FILE|none");
  verb.add_option("--time-limit", r.time_limit,
                  "seconds; the map is left as it is then, and nothing is written where there is "
                  "none")
      ->check(non_negative_number(std::numeric_limits<double>::infinity()));
  r.common.add_to(verb);
  verb.footer("Example: majorant quads spot.obj -o quads.obj --count 4000");
  verb.callback([request, run] { *run = [request] { return make_quads(*request); }; });
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
