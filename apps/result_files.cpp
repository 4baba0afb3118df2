#include "apps/result_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "apps/arguments/help_text.h"
#include "apps/page_content.h"
#include "apps/seam_request.h"
#include "apps/streams.h"
#include "majorant/certify/map_proof.h"
#include "majorant/io/files_below.h"
#include "majorant/io/io.h"
#include "majorant/results/global_verdict.h"

namespace majorant::app {
namespace {

void write_table(const FinishedRun& run, const MapFile& file, WrittenFiles& written) {
  const std::string& path = run.outputs.distortion;
  if (path.empty()) return;
  written.write(path, [&] {
    write_distortion(path, file,
                     run.job.result.measures.cut_short
                         ? measure_distortion(*run.job.result.map, scale_of(run.job)).faces
                         : run.job.result.measures.distortion.faces);
  });
}

void write_maps(const FinishedRun& run, const Json& report, WrittenFiles& written) {
  const MapFile file = map_file(run.job);
  FormatOptions formats = run.outputs.formats;
  if (run.job.options.map.injectivity == MapInjectivity::Global)
    formats.tessellation.overlap = Overlap::Excluded;
  std::optional<MapFile> scaffold;
  if (run.job.result.scaffold)
    scaffold = to_map_file(run.job.placement ? (*run.job.placement)(*run.job.result.scaffold)
                                             : *run.job.result.scaffold);
  formats.svg.scaffold = formats.png.scaffold = scaffold;
  formats.svg.points = formats.png.points = shown_points(run.job);
  if (has_page(run.outputs.files)) formats.page = page_of(run, report);
  formats.page.scaffold = scaffold;
  for (const std::string& path : run.outputs.files) {
    if (extension(path) == ".json") continue;
    written.write(path, [&] {
      if (extension(path) == ".csv") return write_trace(path, run.job.record.trace());
      const PolygonMesh* const input =
          run.job.result.other_triangles ? nullptr : run.job.polygons.get();
      write_map(path, file, input, formats,
                proof_of_file(path, promise(run.job, path), file, formats));
      if (!run.common.quiet) say_left_out(path, left_out(path, file, formats, input));
    });
  }
  write_table(run, file, written);
  if (!run.scaffold_file.empty())
    written.write(run.scaffold_file, [&] {
      write_map(run.scaffold_file, scaffold.value(), nullptr, {},
                certification(run.scaffold_file, {}));
    });
}

void write_reports(const FinishedRun& run, Json report, double write_seconds,
                   WrittenFiles& written) {
  std::vector<std::string> paths;
  if (!run.common.report.empty()) paths.push_back(run.common.report);
  for (const std::string& path : run.outputs.files)
    if (extension(path) == ".json") paths.push_back(path);
  report["outputs"] = written.to_json();
  report["seconds"]["write"] = write_seconds;
  report["seconds"]["total"] = seconds_since(run.start);
  for (const std::string& path : paths) written.write(path, [&] { write_json(path, report); });
}

// "(0, 0) to (5.35, 3.95)": the box around the control points.
std::string range_text(const BezierMap& map) {
  const auto points = map.control_points().reshaped(2, map.control_points().size() / 2);
  const Vector2 low = points.rowwise().minCoeff(), high = points.rowwise().maxCoeff();
  return fmt::format("({:.4g}, {:.4g}) to ({:.4g}, {:.4g})", low.x(), low.y(), high.x(), high.y());
}

void summarize(const FinishedRun& run, const WrittenFiles& written) {
  const ParametrizationResult& r = run.job.result;
  if (!run.job.has_result())
    return say("majorant: {}: no valid result: {}{}; no map is written\n", run.map.input,
               status_name(r.status), r.message.empty() ? "" : fmt::format(" ({})", r.message));
  if (run.common.quiet) return;
  if (run.job.cuts) say_untextured(run.map.input, *run.job.cuts);
  written.say_sizes();
  const std::string seams = seam_summary(measures_section(*r.map, r.measures, run.map.energy));
  say("{}: {} after {}, {} {:.6f} (start {:.6g}){}, degree {}{}, {}, layout {}, {:.2f} s\n",
      run.map.input, status_name(r.status),
      count_text(steps_taken(run.job.record.trace()), "iteration"), run.map.energy,
      r.measures.value, r.initial_value,
      run.map.weights.empty() ? "" : ", both without the face weights", run.map.degree, seams,
      overlap_words(run.job.boundary, image_of(*r.map)), range_text(*r.map),
      seconds_since(run.start));
}

}  // namespace

void OutputRequest::add_to(CLI::App& verb) {
  begin_group(verb, OptionGroup::Files);
  verb.add_option("output", positional, "output file, same as -o");
  verb.add_option("-o,--output", files, output_help(extensions))
      ->type_name("FILE")
      ->allow_extra_args(false);
  formats.add_to(verb);
  begin_group(verb, OptionGroup::Files);
  verb.add_option("--distortion", distortion,
                  "write a table of stretch, area and angle distortion per face to FILE.csv")
      ->type_name("FILE");
  verb.add_flag(
      "--normalize", normalize,
      "move, turn and scale the result into the unit square; --align no, seams and a fixed "
      "boundary keep it from being turned");
}

void OutputRequest::require_usable(const MapRequest& map) {
  if (!positional.empty()) files.push_back(positional);
  require_some_output(files, extensions);
  formats.require_effect(files);
  if (normalize && !(map.pins.empty() && map.handles.empty()))
    throw Error(ErrorKind::Usage, "--normalize moves pins and handles; leave one of the two out");
  if (!turns_map()) return;
  if (!(map.pins.empty() && map.handles.empty()))
    throw Error(ErrorKind::Usage,
                "--align turns pins and handles in data files and pages; leave one of the two out");
  if (map.boundary == "fixed")
    throw Error(ErrorKind::Usage,
                "--align turns the boundary that --boundary fixed holds, in data files and pages; "
                "leave one of the two out");
}

bool OutputRequest::turns(const BezierMap& result, const MapRequest& map) const {
  const bool is_free = map.boundary != "fixed" && result.seams().trivial();
  return turns_map() || (normalize && formats.svg.alignment == Alignment::Automatic && is_free);
}

void OutputRequest::require_materials(const PolygonMesh& input) const {
  if (std::any_of(files.begin(), files.end(),
                  [](const std::string& path) { return extension(path) == ".obj"; }))
    require_materials_below(input);
}

bool OutputRequest::has_report(const CommonOptions& common) const {
  return !common.report.empty() ||
         std::any_of(files.begin(), files.end(),
                     [](const std::string& path) { return extension(path) == ".json"; });
}

int write_result(const FinishedRun& run) {
  Json report;
  if (run.outputs.has_report(run.common) || has_page(run.outputs.files))
    report = map_report(run.job);
  const double before = seconds_since(run.start);
  WrittenFiles written;
  run.job.record.begin(Activity::Writing);
  if (run.job.has_result()) write_maps(run, report, written);
  write_reports(run, std::move(report), seconds_since(run.start) - before, written);
  run.progress.finish();
  summarize(run, written);
  return written.conclude(exit_code(run.job.result.status));
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
