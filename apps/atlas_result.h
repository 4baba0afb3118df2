// What unwrap leaves behind: files with their claims, the report, the lines that sum up.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "apps/command.h"
#include "apps/map_request.h"
#include "apps/progress.h"
#include "apps/result_files.h"
#include "majorant/mesh/repair.h"
#include "majorant/parametrization/atlas/unit_square.h"
#include "majorant/parametrization/atlas/unwrap.h"

namespace majorant::app {

// A run of unwrap that has ended. Only refers: all must outlive it.
struct FinishedAtlas {
  const CommonOptions& common;
  const OutputRequest& outputs;
  const MapRequest& map;
  const PolygonMesh& polygons;
  const RepairedSurface& surface;
  const Atlas& atlas;
  const std::optional<AtlasSquare>& square;  // what the maps were moved into
  const RunRecord& record;
  const std::vector<Pin>& handles;              // of vertices of the surface
  Json options;                                 // as said
  std::chrono::steady_clock::time_point start;  // of the run
  Progress& progress;
  double read_seconds = 0;
};

// Writes the layout, unless a chart failed, each file certified, then the reports, then the lines
// on stderr; returns the exit code.
int write_atlas(const FinishedAtlas& run);

}  // namespace majorant::app
