// A run of a verb that makes a map (parametrize, seamless, deform): what all of them can be told,
// what happens before the solve and after it.
//
//   MapVerb request;
//   request.add_to(verb);
//   MapRun run("parametrize", request);    // checks what can be checked, starts clocks
//   MapInput& in = run.read();
//   return run.finish(parametrize(in.mesh, in.options, run.record()));  // the exit code
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
#include "majorant/framework/thread_count.h"

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
  MapRun(std::string verb, MapVerb& request, const std::vector<std::string>& other_inputs = {});

  // As read_input; the time that make_start takes counts as initialization.
  MapInput& read(const StartMaker& make_start = {});
  RunRecord& record() { return record_; }
  // extra: options of the verb alone, for reports and claims.
  int finish(ParametrizationResult result, const Json& extra = Json::object());

 private:
  double seconds() const;
  std::optional<LayoutMotion> place(ParametrizationResult& result);

  std::string verb_;
  MapVerb& request_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  Progress progress_;
  RunRecord record_;
  std::optional<ThreadCount> threads_;
  std::optional<LinearSolvers> solvers_;
  MapInput in_;
  std::optional<Film> film_;
  double read_seconds_ = 0, start_seconds_ = 0;
};

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
