// The layout options of `unwrap` besides --padding: upright charts, tiles, texel densities, kept
// shapes.
//
//   LayoutRequest layout;
//   layout.add_to(verb);
//   AtlasJob job(record);
//   layout.apply(job, stop);      // once it is open, with its packing chosen
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "majorant/apps/jobs/atlas_job.h"

namespace majorant::app {

struct LayoutRequest {
  std::string upright = "no";
  int udim = 0;               // 0: not given
  std::string texel_density;  // empty: not given
  std::string stack = "no";
  bool keep_shape = false;
  bool groups = false;
  std::string objects = "together";

  void add_to(CLI::App& verb);
  // Returns the file that --texel-density names, or an empty string.
  std::string density_file() const;
  // Returns whether every object of the file has its own layout.
  bool is_of_objects() const { return objects == "separate"; }
  // Returns whether charts have several scales, lie in several tiles, or share places.
  bool has_own_sizes() const { return udim > 0 || !texel_density.empty() || stack != "no"; }
  // Returns the option that needs the unit square, or an empty string.
  std::string needs_unit_square() const;
  // Throws Error(Usage) for a file without materials, and the errors of read_densities().
  void apply(AtlasJob& job, const StopCheck& stop) const;
  Json to_json() const;  // for reports and claims
};

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
