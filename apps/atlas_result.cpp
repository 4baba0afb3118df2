#include "apps/atlas_result.h"

#include <fmt/format.h>

#include <cmath>

#include "apps/page_content.h"
#include "apps/seam_request.h"
#include "apps/streams.h"
#include "majorant/io/map_distortion.h"
#include "majorant/results/internal/global_verdict.h"

namespace majorant::app {
namespace {

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
        write_map(path, file, run.job.polygons.get(), formats,
                  proof_of_file(path, promise(run.job, path), file, formats));
        if (!run.common.quiet) say_left_out(path, left_out(path, file, formats));
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

// Charts that did not converge, by their first faces.
void name_charts(const FinishedUnwrap& run) {
  for (std::size_t k = 0; k < run.job.atlas.charts.size(); ++k) {
    const Chart& chart = run.job.atlas.charts[k];
    if (chart.status == Status::Converged) continue;
    say("majorant: {}: chart {} (face {} and {} more): {}{}\n", run.map.input, k + 1,
        run.job.surface.mesh->input_face(chart.faces.front()) + 1, chart.faces.size() - 1,
        status_name(chart.status), chart.message.empty() ? "" : ": " + chart.message);
  }
}

void summarize(const FinishedUnwrap& run, const WrittenFiles& written) {
  const Atlas& atlas = run.job.atlas;
  name_charts(run);
  if (run.common.quiet || atlas.status() == Status::Failed) return;
  for (const Repair& r : run.job.surface.repairs) say("{}: {}\n", run.map.input, describe(r));
  say_untextured(run.map.input, atlas.cuts);
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

}  // namespace

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

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
