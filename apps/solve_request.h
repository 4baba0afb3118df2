// The solve of all verbs that optimize a map: its options and limits.
#pragma once

#include <CLI/App.hpp>
#include <limits>
#include <string>

#include "apps/command.h"
#include "apps/output_request.h"
#include "majorant/apps/jobs/report.h"
#include "majorant/framework/minimizer.h"
#include "majorant/parametrization/solve/parametrize.h"

namespace majorant::app {

struct SolveRequest {
  std::string elevation = "incremental";
  int max_iterations = StoppingRules().max_iterations;
  int snapshots = 0;  // iterations from one to the next; 0: none
  bool bijective = false, no_flips = false, improve_mesh = false;
  std::string scaffold_file;  // or empty
  std::string linear_solver = "auto";
  double tolerance = SolveOptions().tolerance, time_limit = std::numeric_limits<double>::infinity();

  // Adds --curvature, which a MapRequest holds, too. Not --linear-solver.
  void add_to(CLI::App& verb, std::string& curvature);
  void add_limits_to(CLI::App& verb, std::string& curvature);  // what any solve can be told
  // Before any work. Throws Error(Usage) for options that do not go together.
  void require_usable(const OutputRequest& outputs, const MapRequest& map) const;
  void apply(ParametrizationOptions& options) const;
  Json to_json() const;
};

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
