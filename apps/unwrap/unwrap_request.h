// The options of `majorant unwrap`: where to cut, how to repair and to pack, and what is refused of
// them before any work.
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

// The options of a layout: how to repair, where to cut, how to pack.
struct UnwrapRequest {
  SeamRequest seams;
  std::string weld = "auto";
  bool keep_seams = false;
  std::string charts = "auto";
  std::optional<double> fill;  // none: what costs little seam
  std::string preset;          // empty: none
  std::string hide_from;       // empty: all sides
  double padding = PackOptions().padding_pixels, resolution = PackOptions().resolution;
  bool no_pack = false;
  std::string scale;          // empty: as `map` allows
  bool bake = false;          // the texture of the model, too
  std::optional<int> uv_set;  // of glTF; none: that of the preset
  LayoutRequest layout;

  void add_to(CLI::App& verb);
  // Takes from the preset what was not said.
  void use_preset();
  // Throws Error(Usage) for what --seams leaves no room for.
  void require_divisible() const;
  // Opens the job with the file, and says where to cut and how to pack. Throws Error(Unsupported)
  // for what would be repaired, where everything must be whole, and as SeamRequest::options.
  void open(AtlasJob& job, PolygonMesh polygons, Strictness strictness) const;
  RepairOptions repairs() const;
  // Pixels along a side of the image of --bake, where --resolution or the preset says so.
  std::optional<int> image_side() const;
  Json to_json() const;  // for reports and claims

 private:
  bool is_said(const char* option) const { return verb_->get_option(option)->count() > 0; }

  const CLI::App* verb_ = nullptr;
};

struct UnwrapVerb {
  CommonOptions common;
  MapRequest map;
  OutputRequest outputs;
  SolveRequest solve;
  UnwrapRequest unwrap;

  void add_to(CLI::App& verb);
  // Takes defaults from the preset and from what the outputs are. Throws Error(Usage) before any
  // work.
  void require_usable();
  // The files that are read.
  std::vector<std::string> inputs() const;
  // The output options, with the extensions that each takes.
  std::vector<OutputNames> output_names() const;
  // The outputs that the texture moves to with --bake: of an OBJ an OBJ and a glTF, of a glTF a
  // glTF. Throws Error(Usage) for several of a kind.
  std::vector<std::string> baked_outputs() const;
  Json to_json() const;  // for reports and claims
};

// The files that --bake writes beside the model.
std::vector<std::string> files_beside(const std::string& model);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
