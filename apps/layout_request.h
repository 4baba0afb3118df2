// How the charts of `unwrap` lie, beside --padding: turned upright, in tiles, as dense as asked, in
// the shapes that they have.
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
  int udim = 0;               // 0: nothing was said
  std::string texel_density;  // empty: likewise
  std::string stack = "no";
  bool keep_shape = false;
  bool groups = false;
  std::string objects = "together";

  void add_to(CLI::App& verb);
  // The file that --texel-density names, or empty.
  std::string density_file() const;
  // True where every object of the file has a layout of its own.
  bool is_of_objects() const { return objects == "separate"; }
  // True where charts have several scales, tiles, or one place for several of them.
  bool has_own_sizes() const { return udim > 0 || !texel_density.empty() || stack != "no"; }
  // Options that need the unit square, as words, or empty.
  std::string needs_unit_square() const;
  // Throws Error(Usage) for a file without materials, and as read_densities().
  void apply(AtlasJob& job, const StopCheck& stop) const;
  Json to_json() const;  // for reports and claims
};

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
