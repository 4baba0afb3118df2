// The common end of the verbs that optimize a map: output options, files with their claims,
// reports, and the line that sums up.
//
//   MapRequest map_request;
//   OutputRequest outputs;
//   outputs.add_to(verb);                  // -o --refine --grid ...
//   outputs.require_usable(map_request);   // before any work
//
// and, when there is a FinishedRun, write_result(run) ends the verb.
#pragma once

#include <CLI/App.hpp>
#include <chrono>
#include <string>
#include <vector>

#include "apps/command.h"
#include "apps/map_request.h"
#include "apps/outputs.h"
#include "apps/progress.h"
#include "majorant/results/map_job.h"

namespace majorant::app {

// The files that the result goes to, as the user named them.
struct OutputRequest {
  std::string positional;
  std::vector<std::string> files;
  std::vector<std::string> extensions = map_extensions({".json", ".csv"});  // that the verb writes
  FormatOptions formats;
  std::string distortion;  // table per face, or empty
  bool normalize = false;

  // Adds a positional `output` too: call it after the verb's input.
  void add_to(CLI::App& verb);
  // Joins the positional file to `files`. Throws Error(Usage) when there is no output, or what was
  // asked for would move what is held.
  void require_usable(const MapRequest& map);
  // Returns whether --align turns the map itself.
  bool turns_map() const { return formats.turns_map(files); }
  // Returns whether this result is turned: that, or --normalize where nothing holds it as it is.
  bool turns(const BezierMap& result, const MapRequest& map) const;
  // Returns whether a report is asked for, by a flag or as an output.
  bool has_report(const CommonOptions& common) const;
  // Throws Error(Unsupported) where an OBJ would name material files of the input that are not in
  // its folder or below.
  void require_materials(const PolygonMesh& input) const;
};

// A run that has ended. Only refers: all must outlive it.
struct FinishedRun {
  const CommonOptions& common;
  const OutputRequest& outputs;
  const MapRequest& map;
  const MapJob& job;
  std::chrono::steady_clock::time_point start;  // of the run
  std::string scaffold_file;                    // or empty
  Progress& progress;
};

// Writes the maps if there is a result, each certified as the run promised (certify/map_proof.h),
// then the reports, each file on its own, then the line on stderr; returns the exit code.
int write_result(const FinishedRun& run);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
