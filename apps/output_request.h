// The output options of a map, and the checks of them before any work.
//
//   MapRequest map_request;
//   OutputRequest outputs;
//   outputs.add_to(verb);                  // -o --refine --grid ...
//   outputs.require_usable(map_request);   // before any work
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "apps/command.h"
#include "apps/map_request.h"
#include "apps/outputs.h"
#include "majorant/apps/jobs/map_job.h"

namespace majorant::app {

// The output files as the user named them.
struct OutputRequest {
  std::string positional;
  std::vector<std::string> files;
  // formats that the verb writes
  std::vector<std::string> extensions = map_extensions({".json", ".csv"});
  FormatOptions formats;
  std::string distortion;  // file of the table of distortions, or empty
  bool normalize = false;

  // Adds the options and a positional `output`. Call it after the verb's input.
  void add_to(CLI::App& verb);
  // Adds the positional file to `files`. Throws Error(Usage) if there is no output, or if an option
  // would move points that others hold.
  void require_usable(const MapRequest& map);
  // Returns the output options of a run with the extensions that each accepts.
  std::vector<OutputNames> names() const;
  // Returns whether --align turns the map itself, not only pictures.
  bool turns_map() const { return formats.turns_map(files); }
  // Returns whether this result is turned, by --align, or by --normalize if nothing holds its
  // direction.
  bool turns(const BezierMap& result, const MapRequest& map) const;
  // Throws Error(Unsupported) if an OBJ would name material files of the input outside of its
  // folder.
  void require_materials(const PolygonMesh& input) const;
  // Returns a warning if an OBJ would show pictures of the input that fit the old layout, or none.
  std::vector<std::string> stale_pictures(const PolygonMesh& input,
                                          const std::string& remedy) const;
};

// Throws Error(Usage) for a format that cannot hold the seams of a seamless map: their sides agree
// to kSeamClose of the layout, floats to 1e-7.
void require_holds_seams(const std::vector<std::string>& files);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
