// The options of `majorant bake`: the data, their source, and the form of the image.
#pragma once

#include <CLI/App.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "apps/command.h"
#include "majorant/apps/jobs/bake_job.h"

namespace majorant::app {

struct BakeRequest {
  CommonOptions common;
  std::string surface, from, positional_output, image, attribute;
  std::vector<std::string> outputs;
  std::string size, method = "auto", filter = "bilinear";
  std::optional<double> distance;
  std::optional<int> padding, depth;
  int samples = 1;
  bool linear = false;
  double time_limit = std::numeric_limits<double>::infinity();

  // Returns the file or the word that names the data.
  std::string input_of_values() const { return image.empty() ? attribute : image; }
  // Returns whether OLD's own textures are baked, because no other data are named.
  bool is_of_model() const { return image.empty() && attribute.empty(); }
  bool names_file() const;

  void add_to(CLI::App& verb);
  // Adds the positional output to `outputs`. Throws Error(Usage) for options that conflict;
  // Error(Unsupported) for data that cannot be baked.
  void require_usable();
  const std::string& output() const { return outputs.front(); }
  // Returns the file that write_baked() writes beside an array of numbers, or none.
  std::vector<std::string> labels() const;
  // Sets the form of the image. Call it after the images to bake have been read.
  void apply(BakeJob& job) const;
  Json to_json(const BakeJob& job) const;  // for reports
};

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
