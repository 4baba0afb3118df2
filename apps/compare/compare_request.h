// The options of `majorant compare`, and the report of a comparison.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "apps/command.h"
#include "apps/compare/linear_solver_run.h"
#include "apps/compare/methods.h"
#include "apps/map_request.h"
#include "apps/outputs.h"
#include "majorant/apps/jobs/report.h"

namespace majorant::app {

struct CompareRequest {
  CommonOptions common;
  MapRequest map;
  std::string other;  // a second result, or empty
  std::vector<std::string> outputs, methods, linear_solvers;
  FormatOptions formats;
  int max_iterations = StoppingRules().max_iterations;
  double tolerance = 1e-9;  // relative decrease; see StoppingRules
  double time_limit = ComparisonOptions().time_limit_seconds;

  void add_to(CLI::App& verb);
  // Throws Error(Usage) if an option of one problem is combined with two results, or the reverse.
  void require_fitting(const CLI::App& verb) const;
  // Returns the named methods without repetitions, or all default methods. Throws Error(Usage).
  std::vector<const Method*> chosen_methods() const;
  std::vector<std::string> chosen_linear_solvers() const;
};

// Returns the report of a comparison of methods.
RunReport comparison_report(const CompareRequest& request, const Comparison& comparison,
                            const std::vector<LinearSolverRun>& solvers);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
