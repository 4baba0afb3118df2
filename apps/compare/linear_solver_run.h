// `majorant compare --linear-solvers`: what solves Newton's systems, each on the same matrix, the
// projected Hessian at the start, and its gradient.
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
  std::string message;      // why there is nothing else: it cannot be loaded, or it failed
  // Seconds of the processor, all threads: the median of several repetitions.
  double analyze_seconds = 0, factorize_seconds = 0, solve_seconds = 0;
  std::size_t memory_bytes = 0;  // that the process had at most beyond what it had before
  double residual = 0;           // |H p + g| / |g|
};

// The names of --linear-solver, and "eigen".
std::vector<std::string> linear_solver_names();
// Measures one of them; where it cannot be had, or fails, its message says why.
LinearSolverRun measure_linear_solver(const std::string& name, const Problem& problem,
                                      const Vec& y);
// Makes one of them. Throws Error where the library that has it cannot be loaded.
std::shared_ptr<LinearSolver> linear_solver_named(const std::string& name);
// NewtonOptions::near_null_space of a map, for multigrid.
std::function<Eigen::MatrixXd(const Problem&)> near_null_space_of_maps();
std::string linear_solver_table(const std::vector<LinearSolverRun>& runs);
Json linear_solvers_section(const std::vector<LinearSolverRun>& runs);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
