// The JSON report, schema_version 1, section by section, and the CSV trace.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "majorant/framework/partition.h"
#include "majorant/framework/run_record.h"
#include "majorant/mesh/repair.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/parametrization/maps/measure.h"
#include "majorant/parametrization/seams/choose_cuts.h"

namespace majorant {

using Json = nlohmann::ordered_json;

Json input_section(const PolygonMesh& polygons, const SurfaceMesh& mesh);
// [{"vertex": of the input, "quarter_turns": q, "index": (4 - q) / 4}].
Json cones_section(const BezierMap& map);
struct MapSize {
  int degree;
  GlobalIndex control_points;
};
// value, extremes, injectivity: the part of "result" that any map has, also one in parts.
// least_det: the least of measures.min_det of all of them.
Json measures_section(const MapSize& size, const MapMeasures& measures, double least_det,
                      const std::string& energy);
// The same, with the cones of maps with seams.
Json measures_section(const BezierMap& map, const MapMeasures& measures, const std::string& energy);
// Percentiles, means and stretch of all parts as one map, measured at that scale of the layout.
Json distortion_section(const std::vector<const MapDistortion*>& parts, double scale);
// {"seam_length": ..., ...}: what reports say of cuts. area: of the surface.
Json cuts_section(const SurfaceCuts& cuts, double area);
// The section of cuts of a repaired surface: with the edges that repair cut, which are in the sums.
Json cuts_section(const SurfaceCuts& cuts, const RepairedSurface& surface);
// The words with which a line that sums up tells of that section's seams, ", ..."; empty when there
// are none.
std::string seam_summary(const Json& measures_section);
// {"deepen": {"runs": 2, "gained": 0.01}, ...} of every remedy, energies as in the trace.
Json remedies_section(const RemedyUses& uses);
Json iterations_section(const std::vector<TraceEntry>& trace);
long peak_memory_bytes();
// Adds what the run took and took place on: "linear_solver", "memory" (sections, or null),
// "peak_memory_bytes", "threads", "vector_instructions".
void add_resources(Json& report, const Json& linear_solver, const Json& memory);

// The same with file names in place of paths, for what is handed on: in every text of it those of
// `paths`, and of `options` all that have a folder.
Json without_folders(Json json, const std::vector<std::string>& paths = {});

// The text of every JSON that the command writes: numbers with 17 digits where needed; not finite
// becomes null; bytes that are not UTF-8 (of paths) become U+FFFD. indent -1: on one line.
std::string json_text(const Json& json, int indent = -1);
void write_trace(const std::string& path, const std::vector<TraceEntry>& trace);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
