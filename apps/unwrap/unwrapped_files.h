// The files, the report and the lines of a finished unwrap: of one layout, or of a layout for each
// object.
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

// The unwrap of a mesh to one layout.
struct UnwrapRun {
  const UnwrapVerb& request;
  AtlasJob job;
  std::optional<ModelTexture> texture = {};  // texture to bake
  std::vector<std::string> baked = {};       // outputs that receive the texture

  bool is_baked(const std::string& path) const {
    return std::find(baked.begin(), baked.end(), path) != baked.end();
  }
};
// Returns the files and lines of a solved, placed and proven job. The result refers to `run` and
// `clock`.
Made made_of(const UnwrapRun& run, const Run& clock, bool is_reported);

// The unwrap of a file to a layout for each object.
struct ObjectsRun {
  const UnwrapVerb& request;
  PolygonMesh polygons = {};
  std::vector<std::string> faults = {};  // lines about charts that did not converge
  std::vector<std::string> lines = {};   // summary lines, by object

  // Adds the lines about an object with this file name.
  void add_lines(const AtlasJob& job, const std::string& file);
};
// Returns the files and lines of all objects. The result refers to `run`.
Made made_of(const ObjectsRun& run, UnwrappedObjects objects);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
