// The options of `majorant unwrap`: cuts, repairs and packing, and the checks of them before any
// work.
//
//   UnwrapVerb request;
//   request.add_to(verb);
//   request.require_usable();
//   AtlasJob job(record);
//   request.unwrap.open(job, read_mesh(path), Strictness::Shape);
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/command.h"
#include "apps/layout_request.h"
#include "apps/map_request.h"
#include "apps/output_request.h"
#include "apps/seam_request.h"
#include "apps/solve_request.h"
#include "majorant/apps/jobs/atlas_job.h"

namespace majorant::app {

// The options of a layout: repairs, cuts, packing.
struct UnwrapRequest {
  SeamRequest seams;
  std::string weld = "auto";
  bool keep_seams = false;
  std::string charts = "auto";
  std::optional<double> fill;  // none: as much as costs little seam
  std::string preset;          // empty: no preset
  std::string hide_from;       // empty: all sides
  double padding = PackOptions().padding_pixels, resolution = PackOptions().resolution;
  bool no_pack = false;
  std::string scale;          // empty: depends on `map`
  bool bake = false;          // move the texture of the model
  std::optional<int> uv_set;  // for glTF; none: that of the preset
  LayoutRequest layout;

  void add_to(CLI::App& verb);
  // Sets the options that were not given to the values of the preset.
  void use_preset();
  // Throws Error(Usage) for options that conflict with --seams.
  void require_divisible() const;
  // Opens the job with the file, and sets cuts and packing. Throws Error(Unsupported) for repairs
  // if strictness is Everything, and the errors of SeamRequest::options().
  void open(AtlasJob& job, PolygonMesh polygons, Strictness strictness) const;
  RepairOptions repairs() const;
  // Returns the side of the image of --bake in pixels, if --resolution or a preset is given.
  std::optional<int> image_side() const;
  Json to_json() const;  // for reports and claims

 private:
  bool is_given(const char* option) const { return verb_->get_option(option)->count() > 0; }

  const CLI::App* verb_ = nullptr;
};

struct UnwrapVerb {
  CommonOptions common;
  MapRequest map;
  OutputRequest outputs;
  SolveRequest solve;
  UnwrapRequest unwrap;

  void add_to(CLI::App& verb);
  // Applies the preset and the defaults that depend on the outputs. Throws Error(Usage) before any
  // work.
  void require_usable();
  // Returns the files to read.
  std::vector<std::string> inputs() const;
  // Returns the output options with the extensions that each accepts.
  std::vector<OutputNames> output_names() const;
  // Returns the outputs that receive the texture with --bake: an OBJ and a glTF from an OBJ, a glTF
  // from a glTF. Throws Error(Usage) for several of one kind.
  std::vector<std::string> baked_outputs() const;
  Json to_json() const;  // for reports and claims
};

// Returns the files that --bake writes beside the model.
std::vector<std::string> files_beside(const std::string& model);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
