// The run of parametrize, seamless and deform, which make one map of a surface: their options, a
// MapJob from the file to its result, and the output files.
//
//   MapVerb request;
//   request.add_to(verb);
//   return run_map(MapTask::Parametrize, request, {});   // the exit code
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "apps/command.h"
#include "apps/map_request.h"
#include "apps/output_request.h"
#include "apps/solve_request.h"

namespace majorant::app {

// The options of such a verb, as the user gave them.
struct MapVerb {
  CommonOptions common;
  MapRequest map;
  OutputRequest outputs;
  SolveRequest solve;

  void add_to(CLI::App& verb);
};

// The parts of a run that are particular to one verb.
struct MapVerbParts {
  std::vector<std::string> inputs = {};  // further files to read
  StartMaker make_start = {};            // see read_input()
  Json options = Json::object();         // for reports and claims
};

// Runs the task and returns the exit code. Throws Error(Usage) before any work.
int run_map(MapTask task, MapVerb& request, const MapVerbParts& parts);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
