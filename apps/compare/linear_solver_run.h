// `majorant compare --linear-solvers`: measures linear solvers on one Newton system, the projected
// Hessian and the gradient at the start.
//
//   std::vector<LinearSolverRun> runs;
//   for (const std::string& name : linear_solver_names())
//     runs.push_back(measure_linear_solver(name, problem, y0));
//   std::cout << linear_solver_table(runs);
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "majorant/apps/jobs/report.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/framework/problem.h"

namespace majorant::app {

struct LinearSolverRun {
  std::string name;
  std::string description;  // LinearSolver::description()
  std::string message;      // why the measurement is missing: the library cannot be loaded, or the
                            // solver failed
  // Processor seconds of all threads: medians of several repetitions.
  double analyze_seconds = 0, factorize_seconds = 0, solve_seconds = 0;
  std::size_t memory_bytes = 0;  // peak memory of the process beyond its memory before
  double residual = 0;           // |H p + g| / |g|
};

// Returns the names of --linear-solver, and "eigen".
std::vector<std::string> linear_solver_names();
// Measures one solver. If it cannot be loaded or fails, the message of the result says why.
LinearSolverRun measure_linear_solver(const std::string& name, const Problem& problem,
                                      const Vec& y);
// Makes a solver by its name. Throws Error if its library cannot be loaded.
std::shared_ptr<LinearSolver> linear_solver_named(const std::string& name);
// Returns NewtonOptions::near_null_space for maps, which multigrid needs.
std::function<Eigen::MatrixXd(const Problem&)> near_null_space_of_maps();
std::string linear_solver_table(const std::vector<LinearSolverRun>& runs);
Json linear_solvers_section(const std::vector<LinearSolverRun>& runs);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
