// The run of the verbs that make one map of a surface, parametrize, seamless and deform: what all
// of them can be told, a MapJob from the file to its result, and the files in the end.
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

// Everything the user can say, as said.
struct MapVerb {
  CommonOptions common;
  MapRequest map;
  OutputRequest outputs;
  SolveRequest solve;

  void add_to(CLI::App& verb);
};

// The parts of a run that one of the verbs has alone.
struct MapVerbParts {
  std::vector<std::string> inputs = {};  // files that it reads
  StartMaker make_start = {};            // as read_input() takes it
  Json options = Json::object();         // for reports and claims
};

// Throws Error(Usage) before any work; returns the exit code.
int run_map(MapTask task, MapVerb& request, const MapVerbParts& parts);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
