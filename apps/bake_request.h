// The options of `majorant bake`: what is baked, from where, and how the image is kept.
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

  // The file or the word that says what is baked.
  std::string input_of_values() const { return image.empty() ? attribute : image; }
  // Returns whether OLD's own textures are baked, since nothing else is named.
  bool is_of_model() const { return image.empty() && attribute.empty(); }
  bool names_file() const;

  void add_to(CLI::App& verb);
  // Joins the positional output to `outputs`. Throws Error(Usage) before any work;
  // Error(Unsupported) for what is not baked.
  void require_usable();
  const std::string& output() const { return outputs.front(); }
  // The file that write_baked() writes beside numbers, or none.
  std::vector<std::string> labels() const;
  // Says how the image is kept; the images to bake have been read.
  void apply(BakeJob& job) const;
  Json to_json(const BakeJob& job) const;  // for reports
};

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
