// The solver options and limits of the verbs that optimize a map.
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
  int snapshots = 0;  // iterations between two snapshots; 0: none
  bool bijective = false, no_flips = false, improve_mesh = false;
  std::string scaffold_file;  // or empty
  std::string effort = "normal";
  std::string linear_solver = "auto";
  double tolerance = SolveOptions().tolerance, time_limit = std::numeric_limits<double>::infinity();

  // Adds these options and --curvature, whose value a MapRequest holds. Does not add
  // --linear-solver.
  void add_to(CLI::App& verb, std::string& curvature);
  void add_effort_to(CLI::App& verb);                          // adds --effort, for parametrize
  void add_limits_to(CLI::App& verb, std::string& curvature);  // adds the options of all solves
  // Throws Error(Usage) for options that conflict. Call it before any work.
  void require_usable(const OutputRequest& outputs, const MapRequest& map) const;
  void apply(ParametrizationOptions& options) const;
  Json to_json() const;
};

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
