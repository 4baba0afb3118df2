// A MapJob as the verbs parametrize, seamless and deform run it: what all of them can be told, the
// checks before any work, limits, progress and linear solver, and the files in the end.
//
//   MapVerb request;
//   request.add_to(verb);
//   MapRun run(MapTask::Parametrize, request);    // checks what can be checked, starts clocks
//   run.read();
//   return run.finish();  // the exit code
#pragma once

#include <CLI/App.hpp>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "apps/command.h"
#include "apps/linear_solvers.h"
#include "apps/map_request.h"
#include "apps/progress.h"
#include "apps/result_files.h"
#include "apps/solve_request.h"
#include "majorant/framework/parallel.h"

namespace majorant::app {

// Everything the user can say, as said.
struct MapVerb {
  CommonOptions common;
  MapRequest map;
  OutputRequest outputs;
  SolveRequest solve;

  void add_to(CLI::App& verb);
};

class MapRun {
 public:
  // request: outlives the run. other_inputs: files that the verb alone reads. Throws Error(Usage)
  // before any work.
  MapRun(MapTask task, MapVerb& request, const std::vector<std::string>& other_inputs = {});

  MapJob& job() { return job_; }
  // As read_input().
  void read(const StartMaker& make_start = {});
  // Solves, and writes what came out; the exit code. extra: options of the verb alone, for reports
  // and claims.
  int finish(const Json& extra = Json::object());

 private:
  void place();

  MapVerb& request_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  Progress progress_;
  RunRecord record_;
  MapJob job_;
  std::optional<ThreadCount> threads_;
  std::optional<LinearSolvers> solvers_;
};

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
