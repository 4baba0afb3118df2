// The files, the report and the lines of an unwrap that has ended: of one layout, and of a layout
// for each object of a file.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "apps/run.h"
#include "apps/unwrap/unwrap_request.h"
#include "majorant/apps/jobs/atlas_job.h"
#include "majorant/apps/jobs/model_texture.h"
#include "majorant/apps/jobs/object_layouts.h"

namespace majorant::app {

// One layout of a mesh.
struct UnwrapRun {
  const UnwrapVerb& request;
  AtlasJob job;
  std::optional<ModelTexture> texture = {};  // to be baked
  std::vector<std::string> baked = {};       // the outputs that it moves to

  bool is_baked(const std::string& path) const {
    return std::find(baked.begin(), baked.end(), path) != baked.end();
  }
};
// Returns the files and lines of a job that is solved, in place and proven. The result refers to
// `run` and `clock`.
Made made_of(const UnwrapRun& run, const Run& clock, bool is_reported);

// A layout for each object of a file.
struct ObjectsRun {
  const UnwrapVerb& request;
  PolygonMesh polygons = {};
  std::vector<std::string> faults = {};  // lines of charts that did not converge
  std::vector<std::string> lines = {};   // lines that sum up, by object

  // Adds what is said of an object, whose file is named so.
  void add_lines(const AtlasJob& job, const std::string& file);
};
// The result refers to `run`.
Made made_of(const ObjectsRun& run, UnwrappedObjects objects);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
