// The files that a map goes to: output options, and what is refused of them before any work.
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
  // The output options of a run, with the extensions that each takes.
  std::vector<OutputNames> names() const;
  // Returns whether --align turns the map itself.
  bool turns_map() const { return formats.turns_map(files); }
  // Returns whether this result is turned: that, or --normalize where nothing holds it as it is.
  bool turns(const BezierMap& result, const MapRequest& map) const;
  // Throws Error(Unsupported) where an OBJ would name material files of the input that are not in
  // its folder or below.
  void require_materials(const PolygonMesh& input) const;
  // Returns a warning where an OBJ would show pictures of the input that fit its old layout, or
  // none.
  std::vector<std::string> stale_pictures(const PolygonMesh& input,
                                          const std::string& remedy) const;
};

// Throws Error(Usage) for a file that cannot hold the seams of a seamless map: their sides fit to
// kSeamClose of the layout, floats to 1e-7.
void require_holds_seams(const std::vector<std::string>& files);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
