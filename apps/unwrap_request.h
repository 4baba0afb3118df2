// What the user can say of a layout: how to repair, where to cut, how to pack.
//
//   UnwrapRequest request;
//   request.add_to(verb);
//   AtlasJob job(record);
//   request.open(job, read_mesh(path), common.strictness());
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "apps/seam_request.h"
#include "majorant/results/internal/atlas_job.h"

namespace majorant::app {

struct UnwrapRequest {
  SeamRequest seams;
  std::optional<double> weld;
  double padding = PackOptions().padding_pixels, resolution = PackOptions().resolution;
  bool no_pack = false;

  void add_to(CLI::App& verb);
  // Opens the job with the file, and says where to cut and how to pack. Throws Error(Unsupported)
  // for what would be repaired, where everything must be whole, and as SeamRequest::options.
  void open(AtlasJob& job, PolygonMesh polygons, Strictness strictness) const;
  Json to_json() const;  // for reports and claims
};

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
