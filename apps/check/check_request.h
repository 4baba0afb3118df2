// The options of `majorant check`, and its verdict in words.
#pragma once

#include <CLI/App.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "apps/command.h"
#include "majorant/apps/jobs/check_map.h"
#include "majorant/apps/jobs/report.h"

namespace majorant::app {

struct CheckVerb {
  CommonOptions common;
  std::string result, surface, distortion, features;
  std::string cuts = "auto", objects = "together";
  std::vector<std::string> outputs;  // pages
  double time_limit = std::numeric_limits<double>::infinity();
  std::optional<double> max_distance;    // for quads; part of the surface's diagonal
  std::optional<double> border_corners;  // for quads; degrees
  bool certify = false, seamless = false, quads = false, stacked = false;

  void add_to(CLI::App& verb);
  // Throws Error(Usage) for options of maps if the file is a quad mesh.
  void require_of_quads() const;
  CheckRequest::Cuts cut_rule() const;
  Json to_json() const;  // for reports
};

// Returns one line: "FILE: valid, degree 3: ...", "FILE: invalid: ..." or "FILE: undecided: ...".
std::string verdict_of(const CheckVerb& request, const MapFile& file, const MapCheck& check);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
