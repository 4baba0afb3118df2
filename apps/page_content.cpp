#include "apps/page_content.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "apps/outputs.h"

namespace majorant::app {
namespace {

std::vector<PagePoint> held_points(const BezierMap& map, const std::vector<Pin>& pins) {
  std::vector<PagePoint> points;
  for (const Pin& pin : pins)
    points.push_back({map.mesh().input_vertex(pin.vertex),
                      map.control_points().segment<2>(2 * pin.vertex), PagePoint::Hold::Pin});
  return points;
}

// In the units of the result's file.
std::vector<PageSnapshot> frames_of(const FinishedRun& run) {
  const int last = last_iteration(run.job.record.trace());
  std::vector<PageSnapshot> frames =
      run.job.film->frames({*run.job.result.map, last, run.job.result.value_quadrature});
  if (!run.job.placement) return frames;
  for (std::size_t k = 0; k + 1 < frames.size(); ++k)  // the result has been moved
    frames[k].uv = (*run.job.placement)(frames[k].uv);
  return frames;
}

}  // namespace

std::string page_title(const std::string& input) {
  return std::filesystem::path(input).filename().string();
}

std::string page_facts(Json report, const std::vector<std::string>& paths) {
  for (const char* left_out : {"outputs", "iterations"}) report.erase(left_out);
  return json_text(without_folders(std::move(report), paths));
}

bool is_page(const std::string& path) { return extension(path) == ".html"; }

bool has_page(const std::vector<std::string>& paths) {
  return std::any_of(paths.begin(), paths.end(), is_page);
}

MapPage page_of(const FinishedRun& run, Json report) {
  MapPage page;
  page.title = page_title(run.map.input);
  page.facts = page_facts(std::move(report), run.map.inputs());
  page.points = shown_points(run.job);
  if (run.job.film) page.snapshots = frames_of(run);
  return page;
}

std::vector<PagePoint> shown_points(const MapJob& job) {
  const BezierMap& map = *job.result.map;
  std::vector<PagePoint> points = held_points(map, job.options.map.pins);
  for (const PagePoint& point : pulled_points(job.result.handles, map.mesh()))
    points.push_back(point);
  return points;
}

std::vector<PagePoint> pulled_points(const std::vector<Pin>& handles, const SurfaceMesh& mesh) {
  std::vector<PagePoint> points;
  for (const Pin& handle : handles)
    if (handle.target)
      points.push_back({mesh.input_vertex(handle.vertex), *handle.target, PagePoint::Hold::Handle});
  return points;
}

std::vector<PagePoint> claimed_points(const Claims& claims, const MapFile& map) {
  std::vector<PagePoint> points;
  for (const ClaimedPin& pin : claims.pins.value_or(std::vector<ClaimedPin>()))
    if ((map.input_vertex.array() == pin.vertex).any())
      points.push_back({pin.vertex, pin.target, PagePoint::Hold::Pin});
  return points;
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
