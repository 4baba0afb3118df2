// The JSON report of a run, schema_version 2 (report.schema.json), its sections, and the CSV trace.
//
//   RunReport report{.command = "info", .status = "done"};
//   report.input = {{"file", "bunny.obj"}};
//   report.result["polygons"] = 12;
//   const std::string text = json_text(to_json(report, Json::array()), 1);
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "majorant/framework/partition.h"
#include "majorant/framework/run_record.h"
#include "majorant/maps/measure.h"
#include "majorant/mesh/repair.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/parametrization/seams/choose_cuts.h"

namespace majorant {

using Json = nlohmann::ordered_json;

// The report of a run of any verb. Keys that only some runs have are in `more`.
struct RunReport {
  std::string command = {}, status = {}, message = {};
  Json input = nullptr, options = Json::object(), result = nullptr;
  std::vector<std::string> warnings = {};
  Json seconds = Json::object();  // by stage; "total" and "write" are added when they are known
  Json more = Json::object();     // "iterations", "charts", ...
};
// outputs: [{"file", "written", "message"}], in the order of writing. Threads and memory are those
// of the process at the time of the call.
Json to_json(const RunReport& report, const Json& outputs = Json::array());

Json input_section(const PolygonMesh& polygons, const SurfaceMesh& mesh);
// Returns [{"vertex": of the input, "quarter_turns": q, "index": (4 - q) / 4}].
Json cones_section(const BezierMap& map);
struct MapSize {
  int degree;
  GlobalIndex control_points;
};
// Returns the part of "result" that any map has, also a distributed one: value, extremes,
// injectivity. least_det: the least of measures.min_det.
Json measures_section(const MapSize& size, const MapMeasures& measures, double least_det,
                      const std::string& energy);
// Returns the same section, with the cones of maps with seams.
Json measures_section(const BezierMap& map, const MapMeasures& measures, const std::string& energy);
// Returns percentiles, means and stretch of all parts as one map, measured at that scale of the
// layout.
Json distortion_section(const std::vector<const MapDistortion*>& parts, double scale);
// Returns {"seam_length": ..., ...}, the section of cuts. area: of the surface.
Json cuts_section(const SurfaceCuts& cuts, double area);
// Returns the section of cuts of a repaired surface; the sums include the edges that repair cut.
Json cuts_section(const SurfaceCuts& cuts, const RepairedSurface& surface);
// Returns the clause ", ..." about the seams of that section for a summary; empty without seams.
std::string seam_summary(const Json& measures_section);
// Returns {"deepen": {"runs": 2, "gained": 0.01}, ...} for every remedy, energies as in the trace.
Json remedies_section(const RemedyUses& uses);
Json iterations_section(const std::vector<TraceEntry>& trace);
long peak_memory_bytes();
// Adds the solver: "linear_solver" and "memory" (sections, or null), "vector_instructions".
void add_solver(RunReport& report, const Json& linear_solver, const Json& memory);

// Returns the JSON with file names instead of paths, for publication. In all texts the folders of
// `paths` are removed, in `options` all folders.
Json without_folders(Json json, const std::vector<std::string>& paths = {});

// Returns the text of JSON in the form that the command writes: numbers with 17 digits if needed;
// values that are not finite become null; bytes that are not UTF-8 (in paths) become U+FFFD. indent
// -1: one line.
std::string json_text(const Json& json, int indent = -1);
void write_trace(const std::string& path, const std::vector<TraceEntry>& trace);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
