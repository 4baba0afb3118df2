#include "apps/page_content.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <utility>

#include "apps/outputs.h"
#include "majorant/io/files/input_file.h"

namespace majorant::app {
namespace {

std::vector<PagePoint> held_points(const BezierMap& map, const std::vector<Pin>& pins) {
  std::vector<PagePoint> points;
  for (const Pin& pin : pins)
    points.push_back({map.mesh().input_vertex(pin.vertex),
                      map.control_points().segment<2>(2 * pin.vertex), PagePoint::Hold::Pin});
  return points;
}

// Returns the snapshots of a job, in the units of the result's file.
std::vector<PageSnapshot> frames_of(const MapJob& job) {
  const int last = last_iteration(job.record.trace());
  std::vector<PageSnapshot> frames =
      job.film->frames({*job.result.map, last, job.result.value_quadrature});
  if (!job.placement) return frames;
  for (std::size_t k = 0; k + 1 < frames.size(); ++k)  // the result has been moved after the solve
    frames[k].uv = (*job.placement)(frames[k].uv);
  return frames;
}

// Returns the text of a page about a cell that is not proven to be positive: det J at points of a
// lattice.
std::string describe_fault(const MapProof& proof, Index cell) {
  if (!proof.map()) return "det J is not proven to be positive";
  constexpr int kSteps = 8;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; i + j <= kSteps; ++j) {
      const double a = static_cast<double>(i) / kSteps, b = static_cast<double>(j) / kSteps;
      least = std::min(least, proof.map()->jacobian(cell, {a, b, 1 - a - b}).determinant());
    }
  return least > 0
             ? fmt::format("det J is not proven to be positive, sampled down to {:.3g}", least)
             : fmt::format("turned over: det J is {:.3g} at a point of it", least);
}

}  // namespace

std::string page_title(const std::string& input) {
  return std::filesystem::path(input).filename().string();
}

std::string page_facts(const RunReport& report, const std::vector<std::string>& paths) {
  Json facts = to_json(report);
  for (const char* left_out : {"outputs", "iterations"}) facts.erase(left_out);
  return json_text(without_folders(std::move(facts), paths));
}

bool is_page(const std::string& path) { return is_shown_as(Format::Picture::Page, path); }

bool has_page(const std::vector<std::string>& paths) {
  return std::any_of(paths.begin(), paths.end(), is_page);
}

MapPage page_of(const MapJob& job, const MapRequest& request, const RunReport& report) {
  MapPage page;
  page.title = page_title(request.input);
  page.facts = page_facts(report, request.inputs());
  page.points = shown_points(job);
  if (job.film) page.snapshots = frames_of(job);
  return page;
}

MapPage checked_page(const MapFile& file, const MapCheck& check,
                     const std::vector<std::string>& inputs) {
  MapPage page;
  page.title = page_title(inputs.front());
  page.map = file;
  page.facts = page_facts(check.report, inputs);
  for (const Index cell : check.proof.not_positive)
    page.faults.push_back({cell, describe_fault(check.proof, cell)});
  page.points = claimed_points(check.claims, file);
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
